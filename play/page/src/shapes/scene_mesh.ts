// The meshes that exhibits begin with.

import type { Abut } from "../library";
import type { MeshData } from "./mesh_data";

/** What is stored and what is read, in the order of play/wasm/scene_mesh.h. */
export const sceneMeshes: Readonly<Record<string, string>> = { house: "house", knot: "knotted tube", stone: "stone" };

/** A mesh shape by its name; the first one for other names. It is the caller's to dispose of. */
export function sceneMesh(abut: Abut, name: string): ReturnType<Abut["Mesh"]> {
    return abut.play_scene_mesh(Math.max(Object.keys(sceneMeshes).indexOf(name), 0));
}

/** The points and triangles of a mesh shape. */
export function meshDataOf(shape: ReturnType<Abut["Mesh"]>): MeshData {
    return { points: shape.points(), triangles: shape.triangles() };
}
