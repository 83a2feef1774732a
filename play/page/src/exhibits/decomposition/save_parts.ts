// Parts as a file: binary glTF with a mesh for each.

import { BufferAttribute, BufferGeometry, Mesh, MeshStandardMaterial, Scene } from "three";
import type { MeshData } from "../../shapes/mesh_data";

export async function saveParts(parts: readonly MeshData[]): Promise<void> {
    const { GLTFExporter } = await import("three/examples/jsm/exporters/GLTFExporter.js");
    const scene = new Scene();
    const material = new MeshStandardMaterial();
    parts.forEach(({ points, triangles }, i) => {
        const geometry = new BufferGeometry();
        geometry.setAttribute("position", new BufferAttribute(points, 3));
        geometry.setIndex(new BufferAttribute(triangles, 1));
        const mesh = new Mesh(geometry, material);
        mesh.name = `part ${i + 1}`;
        scene.add(mesh);
    });
    const file = await new GLTFExporter().parseAsync(scene, { binary: true });
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([file as ArrayBuffer], { type: "model/gltf-binary" }));
    link.download = "parts.glb";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
