// Reads and decomposes meshes beside the page, which goes on meanwhile.

import { json, loadLibrary, type Abut } from "../../library";
import { boxOf, refined, type MeshData } from "../../shapes/mesh_data";
import { readMesh } from "../../shapes/read_mesh";
import { maxTriangles, type Decomposition, type Options, type Report, type Result, type Task } from "./task";

interface Written {
    report: Report;
    parts: { points: number[][]; triangles: number[]; centroid: number[]; volume: number }[];
}

const library = loadLibrary();

async function read(name: string, bytes: ArrayBuffer): Promise<MeshData> {
    const mesh = await readMesh(name, bytes);
    const count = mesh.triangles.length / 3;
    if (count > maxTriangles)
        throw new Error(
            `${name} has ${count.toLocaleString("en")} triangles; this exhibit takes at most ${maxTriangles.toLocaleString("en")}.`,
        );
    return mesh;
}

function decompose(abut: Abut, mesh: MeshData, options: Options): Decomposition {
    const shape = abut.Mesh(mesh.points, mesh.triangles);
    const start = performance.now();
    const { parts, report } = json<Written>(abut.play_decompose_mesh(shape, options));
    const milliseconds = performance.now() - start;
    shape.dispose();
    const surface = refined(mesh, boxOf(mesh).longest / 40);
    const all = abut.Compound3(parts.map(({ points }) => ({ type: "polyhedron", points: points.flat() })));
    const { distance } = abut.closest_to_points(all, surface.points) as { distance: Float32Array };
    all.dispose();
    return {
        kind: "decomposition",
        parts: parts.map((part) => ({
            ...part,
            points: Float32Array.from(part.points.flat()),
            triangles: Uint32Array.from(part.triangles),
        })),
        report,
        surface,
        depths: distance.map((value) => Math.max(-value, 0)),
        milliseconds,
    };
}

addEventListener("message", async ({ data }: MessageEvent<Task>) => {
    const answer = (result: Result): void => postMessage(result);
    try {
        if (data.kind === "read") answer({ kind: "mesh", mesh: await read(data.name, data.bytes) });
        else answer(decompose(await library, data.mesh, data.options));
    } catch (error) {
        answer({ kind: "error", message: error instanceof Error ? error.message : String(error) });
    }
});
