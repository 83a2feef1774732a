// What the page and its worker say to each other.

import type { MeshData } from "../../shapes/mesh_data";

export interface Options {
    readonly max_parts: number;
    readonly max_vertices: number;
    readonly concavity: number;
}
export type Task =
    | { readonly kind: "read"; readonly name: string; readonly bytes: ArrayBuffer }
    | { readonly kind: "decompose"; readonly mesh: MeshData; readonly options: Options };

export interface Part extends MeshData {
    readonly centroid: number[];
    readonly volume: number;
}
/** The members of abut::DecomposeReport that are shown. */
export interface Report {
    readonly closed: number;
    readonly mesh_volume: number;
    readonly parts_volume: number;
    readonly farthest: number;
    readonly vertices: number;
    readonly concavity: number[];
}
export interface Decomposition {
    readonly kind: "decomposition";
    readonly parts: Part[];
    readonly report: Report;
    /** The mesh with more points, and how deep each lies within the parts. */
    readonly surface: MeshData;
    readonly depths: Float32Array;
    /** The time that the decomposition took. */
    readonly milliseconds: number;
}
export type Result =
    { readonly kind: "mesh"; readonly mesh: MeshData } | Decomposition | { readonly kind: "error"; readonly message: string };

export const maxTriangles = 200_000;
