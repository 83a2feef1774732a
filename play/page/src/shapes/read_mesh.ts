// The triangles of a file: OBJ, STL and GLB. Errors are sentences for the reader.

import { Mesh, MeshBasicMaterial, Vector3 } from "three";
import type { MeshData } from "./mesh_data";

export const meshEndings = ".obj,.stl,.glb";

/** All meshes of a file as one, with the transforms of its nodes. */
export async function readMesh(name: string, bytes: ArrayBuffer): Promise<MeshData> {
    const ending = name.toLowerCase().slice(-4);
    const mesh = ending === ".obj" ? readObj(name, bytes) : ending === ".stl" ? readStl(name, bytes) : await readGlb(name, bytes);
    if (mesh.triangles.length === 0) throw new Error(`${name} has no triangles.`);
    if (!mesh.points.every(Number.isFinite)) throw new Error(`${name} has a point that is not finite.`);
    return mesh;
}

function readObj(name: string, bytes: ArrayBuffer): MeshData {
    const points: number[] = [];
    const triangles: number[] = [];
    for (const line of new TextDecoder()
        .decode(bytes)
        .replace(/\\\r?\n/g, " ")
        .split("\n")) {
        const [word, ...rest] = line.trim().split(/\s+/);
        if (word === "v") points.push(...rest.slice(0, 3).map(Number));
        if (word !== "f") continue;
        // "7/2/3" names the seventh point, and negative numbers count from the last one.
        const corners = rest.map((text) => Number.parseInt(text, 10)).map((index) => (index < 0 ? points.length / 3 + index : index - 1));
        if (corners.length < 3 || corners.some((corner) => !(corner >= 0 && 3 * corner < points.length)))
            throw new Error(`${name} has a face with a point that does not exist.`);
        for (let i = 2; i < corners.length; ++i) triangles.push(corners[0] ?? 0, corners[i - 1] ?? 0, corners[i] ?? 0);
    }
    return { points: Float32Array.from(points), triangles: Uint32Array.from(triangles) };
}

const stlHeader = 84;
const stlTriangle = 50;

function readStl(name: string, bytes: ArrayBuffer): MeshData {
    const view = new DataView(bytes);
    const count = bytes.byteLength >= stlHeader ? view.getUint32(80, true) : 0;
    if (bytes.byteLength >= stlHeader && bytes.byteLength === stlHeader + stlTriangle * count) {
        const points = Float32Array.from({ length: 9 * count }, (_, i) =>
            view.getFloat32(stlHeader + stlTriangle * Math.floor(i / 9) + 12 + 4 * (i % 9), true),
        );
        return separate(points);
    }
    const text = new TextDecoder().decode(bytes);
    if (!text.trimStart().startsWith("solid"))
        throw new Error(`${name} is no whole STL file: its size does not fit its ${count} triangles.`);
    const numbers = [...text.matchAll(/vertex\s+(\S+)\s+(\S+)\s+(\S+)/g)].flatMap((match) => match.slice(1, 4).map(Number));
    if (numbers.length % 9 !== 0 || !text.includes("endsolid")) throw new Error(`${name} ends within a triangle.`);
    return separate(Float32Array.from(numbers));
}
/** Triangles that share no points. */
function separate(points: Float32Array): MeshData {
    return { points, triangles: Uint32Array.from({ length: points.length / 3 }, (_, i) => i) };
}

const glbMagic = 0x46546c67;

async function readGlb(name: string, bytes: ArrayBuffer): Promise<MeshData> {
    const view = new DataView(bytes);
    if (bytes.byteLength < 20 || view.getUint32(0, true) !== glbMagic) throw new Error(`${name} is no GLB file.`);
    if (view.getUint32(4, true) !== 2) throw new Error(`${name} is glTF of version ${view.getUint32(4, true)}, not 2.`);
    // The file and each of its chunks say how long they are.
    let end = 12;
    while (end + 8 <= bytes.byteLength) end += 8 + view.getUint32(end, true);
    const length = Math.max(view.getUint32(8, true), end);
    if (length > bytes.byteLength) throw new Error(`${name} is cut off: it should have ${length} bytes and has ${bytes.byteLength}.`);
    const { GLTFLoader } = await import("three/examples/jsm/loaders/GLTFLoader.js");
    const material = new MeshBasicMaterial();
    // No material is wanted, and with it no texture.
    const loader = new GLTFLoader().register(() => ({ name: "no materials", loadMaterial: () => Promise.resolve(material) }));
    const file = await loader.parseAsync(bytes, "").catch((error: unknown) => {
        throw new Error(`${name} could not be read: ${error instanceof Error ? error.message : String(error)}`);
    });
    file.scene.updateMatrixWorld(true);
    const points: number[] = [];
    const triangles: number[] = [];
    file.scene.traverse((object) => {
        if (!(object instanceof Mesh)) return;
        const first = points.length / 3;
        const { position } = object.geometry.attributes;
        const { index } = object.geometry;
        if (!position) return;
        const corner = new Vector3();
        for (let i = 0; i < position.count; ++i)
            points.push(...corner.fromBufferAttribute(position, i).applyMatrix4(object.matrixWorld).toArray());
        const count = index ? index.count : position.count;
        for (let i = 0; i + 2 < count; i += 3) for (let k = 0; k < 3; ++k) triangles.push(first + (index ? index.getX(i + k) : i + k));
    });
    return { points: Float32Array.from(points), triangles: Uint32Array.from(triangles) };
}
