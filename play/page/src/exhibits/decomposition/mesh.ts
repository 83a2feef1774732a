// A mesh, how deep its surface lies in its convex parts, and the parts.

import type { Context, Running } from "../../exhibit";
import { dropFiles } from "../../panel/drop";
import { readable } from "../../panel/panel";
import { boxOf, type MeshData } from "../../shapes/mesh_data";
import { meshEndings } from "../../shapes/read_mesh";
import { meshDataOf, sceneMesh, sceneMeshes } from "../../shapes/scene_mesh";
import { Palette } from "../../stage/drawing";
import { asPane3 } from "../../stage/pane3";
import { SolidMesh } from "../../stage/solid_mesh";
import type { State } from "./state";
import { LatestTask } from "./latest_task";
import { apart, partColors } from "./parts";
import { saveParts } from "./save_parts";
import type { Decomposition, Options } from "./task";

const maxBytes = 50e6;

/** The mesh of the last file that was read. It is no part of the link. */
let dropped: { name: string; mesh: MeshData } | undefined;

export function startMesh({ abut, state, panel, panes, changed, restart }: Context<State>): Running {
    const [input, output] = [asPane3(panes[0]), asPane3(panes[1])];
    const palette = new Palette(document.documentElement);
    // A file is read while the mesh before is still decomposed.
    const [reading, decomposing] = [new LatestTask(), new LatestTask()];
    let mesh: MeshData;
    let answer: Decomposition | undefined;
    let surface: SolidMesh | undefined;
    let parts: SolidMesh[] = [];
    let status = "";
    let asked = "";
    let opened = 0;

    if (state.mesh === "file" && !dropped) state.mesh = "knot";
    panel.choice(
        "Mesh",
        { ...sceneMeshes, ...(dropped ? { file: dropped.name } : {}) },
        () => state.mesh,
        (value) => {
            state.mesh = value;
            open();
        },
    );
    panel.slider({
        label: "Parts at most",
        min: 1,
        max: 64,
        step: 1,
        get: () => state.max_parts,
        set: (value) => (state.max_parts = value),
    });
    panel.slider({
        label: "Concavity",
        min: 0.005,
        max: 0.5,
        logarithmic: true,
        get: () => state.concavity,
        set: (value) => (state.concavity = value),
    });
    panel.slider({
        label: "Corners at most",
        min: 4,
        max: 64,
        step: 1,
        get: () => state.max_vertices,
        set: (value) => (state.max_vertices = value),
    });
    panel.slider({ label: "Pulled apart", min: 0, max: 1.5, get: () => state.apart, set: (value) => (state.apart = value) });
    const save = panel.button("Save the parts as glTF", () => void saveParts(answer?.parts ?? []));
    const take = async ([file]: File[]): Promise<void> => {
        if (!file) return;
        const result = await reading.run({ kind: "read", name: file.name, bytes: await file.arrayBuffer() });
        if (result?.kind === "error") throw new Error(result.message);
        if (result?.kind !== "mesh") return;
        dropped = { name: file.name, mesh: result.mesh };
        state.mesh = "file";
        restart();
    };
    dropFiles(panel, input, meshEndings, maxBytes, take);

    function open(): void {
        if (state.mesh === "file" && dropped) mesh = dropped.mesh;
        else {
            const shape = sceneMesh(abut, state.mesh);
            mesh = meshDataOf(shape);
            shape.dispose();
        }
        ++opened;
        clear();
        surface = new SolidMesh(mesh);
        input.scene.add(surface.object);
        const { min, max } = boxOf(mesh);
        input.fit(min, max);
        // Leaves space for the parts that are pulled apart.
        output.fit(...scaled(min, max, 1.4));
    }
    /** Asks for the decomposition that the state wants, once. */
    async function decompose(): Promise<void> {
        const options: Options = { max_parts: state.max_parts, max_vertices: state.max_vertices, concavity: state.concavity };
        const question = JSON.stringify([options, opened]);
        if (question === asked) return;
        asked = question;
        status = "decomposing ...";
        const result = await decomposing.run({ kind: "decompose", mesh, options });
        if (!result || result.kind === "mesh" || question !== asked) return;
        if (result.kind === "error") status = result.message;
        else show(result);
        changed();
    }
    function clear(): void {
        for (const old of [surface, ...parts]) old?.dispose();
        surface = undefined;
        parts = [];
        answer = undefined;
    }
    function show(result: Decomposition): void {
        const deepest = deepestOf(result);
        clear();
        answer = result;
        status = `done in ${readable(result.milliseconds)} ms`;
        surface = new SolidMesh(
            result.surface,
            result.depths.map((depth) => (deepest > 0 ? depth / deepest : 0)),
        );
        parts = result.parts.map((part) => new SolidMesh(part));
        input.scene.add(surface.object);
        output.scene.add(...parts.map((part) => part.object));
    }

    function draw(): void {
        void decompose();
        palette.refresh();
        surface?.setColors(palette.mixed("soft", "back", 0.6), palette.rgb("bad"));
        parts.forEach((part, i) => {
            part.setColors(palette.rgb(partColors[i % partColors.length] ?? "a"));
            const [x = 0, y = 0, z = 0] = apart(centered(answer?.parts[i]?.centroid ?? []), state.apart);
            part.object.position.set(x, y, z);
        });
        input.draw([], () => {});
        output.draw([], () => {});
        save.disabled = !answer;
        panel.answer("parts", String(answer?.parts.length ?? 0));
        panel.answer("corners", String(answer?.report.vertices ?? 0));
        panel.answer(
            "volume",
            answer ? `${readable(answer.report.parts_volume)} of parts, ${readable(answer.report.mesh_volume)} of the mesh` : "",
        );
        panel.answer("deepest", answer ? deepestOf(answer) : 0);
        panel.answer("outside", answer?.report.farthest ?? 0);
        panel.answer("closed", Boolean(answer?.report.closed));
        panel.answer("state", status);
    }
    function centered(centroid: number[]): number[] {
        const { min, max } = boxOf(mesh);
        return centroid.map((x, i) => x - ((min[i] ?? 0) + (max[i] ?? 0)) / 2);
    }

    open();
    return {
        ready: decompose(),
        draw,
        answers: () => ({ ...answer?.report, parts: answer?.parts.length, deepest: answer && deepestOf(answer) }),
        code: () => {
            const { max_parts, max_vertices } = state;
            const concavity = readable(state.concavity);
            return {
                cpp: [
                    "#include <abut/bake.hpp>\n",
                    "abut::DecomposeReport report;",
                    `const abut::DecomposeOptions options{.max_parts = ${max_parts}, .concavity = ${concavity}, .max_vertices = ${max_vertices}, .report = &report};`,
                    "auto parts = abut::decompose(mesh, options);   // of abut::Polyhedron",
                ].join("\n"),
                javascript: [
                    "const mesh = abut.Mesh(points, triangles);",
                    `const options = { max_parts: ${max_parts}, concavity: ${concavity}, max_vertices: ${max_vertices} };`,
                    "const parts = abut.decompose_mesh(mesh, options);",
                ].join("\n"),
            };
        },
        dispose() {
            reading.dispose();
            decomposing.dispose();
            clear();
        },
    };
}

/** A box about the same middle. */
function scaled(min: readonly number[], max: readonly number[], factor: number): [number[], number[]] {
    const corner = (sign: number): number[] =>
        min.map((low, i) => 0.5 * (low + (max[i] ?? 0)) + 0.5 * sign * factor * ((max[i] ?? 0) - low));
    return [corner(-1), corner(1)];
}

function deepestOf({ depths }: Decomposition): number {
    return depths.reduce((deepest, depth) => Math.max(deepest, depth), 0);
}
