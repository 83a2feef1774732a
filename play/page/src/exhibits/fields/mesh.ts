// The field of a mesh: a slice through it, the gradient and the closest point, and on the graphics card shadows and particles.

import type { Context, Running } from "../../exhibit";
import { readable } from "../../panel/panel";
import { boxOf, refined, type MeshData } from "../../shapes/mesh_data";
import { meshDataOf, sceneMesh, sceneMeshes } from "../../shapes/scene_mesh";
import { cppFloat, cppVec, javascriptText } from "../../shapes/source_text";
import { Palette } from "../../stage/drawing";
import { asPane3 } from "../../stage/pane3";
import { SolidMesh } from "../../stage/solid_mesh";
import { FieldShader } from "./field_shader";
import type { State } from "./state";
import { Floor } from "./floor";
import { maxParticles, Particles } from "./particles";
import { drawSample, lampHandle, probeHandle, showSample, type Sample } from "./probe";
import { Slice } from "./slice";

const axes: Readonly<Record<string, string>> = { x: "x", y: "y", z: "z" };
const floorHalf = 3;
const lineSpacing = 0.2;
const minCell = 0.06;

type Point = [number, number, number];

export function startMesh({ abut, state, panel, panes, changed }: Context<State>): Running {
    const [left, right] = [asPane3(panes[0]), asPane3(panes[1])];
    const palette = new Palette(document.documentElement);
    const [shader, rightShader] = [new FieldShader(), new FieldShader()];
    const slice = new Slice(shader, lineSpacing);
    const floor = new Floor(rightShader, floorHalf);
    const particles = Particles.canRun(right.renderer) ? new Particles(right.renderer, rightShader, floorHalf) : undefined;
    let field: InstanceType<typeof abut.Field3> | undefined;
    let surface: MeshData | undefined;
    let cutMesh: SolidMesh | undefined;
    let litMesh: SolidMesh | undefined;
    let baked = "";
    let shone = "";
    let drawn = "";
    let milliseconds = 0;
    let answer: Sample | undefined;

    // A link may hold any number.
    state.cell3 = Math.max(state.cell3, Math.fround(minCell));
    left.scene.add(slice.object);
    right.scene.add(floor.object);
    if (particles) right.scene.add(particles.object);
    panel.choice(
        "Mesh",
        sceneMeshes,
        () => state.mesh,
        (mesh) => (state.mesh = mesh),
    );
    panel.slider({
        label: "Cell",
        min: minCell,
        max: 0.4,
        logarithmic: true,
        get: () => state.cell3,
        set: (value) => (state.cell3 = Math.fround(value)),
    });
    panel.toggle(
        "Gradients",
        () => state.gradients,
        (value) => (state.gradients = value),
    );
    panel.choice(
        "Slice across",
        axes,
        () => state.axis,
        (axis) => (state.axis = axis),
    );
    panel.slider({ label: "Slice", min: 0, max: 1, get: () => state.slice, set: (value) => (state.slice = value) });
    panel.slider({ label: "Softness", min: 0, max: 0.5, get: () => state.softness, set: (value) => (state.softness = Math.fround(value)) });
    if (particles) {
        panel.slider({
            label: "Particles",
            min: 1000,
            max: maxParticles,
            step: 1000,
            get: () => state.particles,
            set: (value) => (state.particles = value),
        });
        panel.toggle(
            "They fall",
            () => state.playing,
            (value) => (state.playing = value),
        );
        panel.button("Let them come in anew", () => {
            particles.restart();
            changed();
        });
    }

    /** Bakes the field if what it shows has changed. */
    function bake(): InstanceType<typeof abut.Field3> {
        const wanted = JSON.stringify([state.mesh, state.cell3, state.gradients]);
        if (field && wanted === baked) return field;
        baked = wanted;
        const shape = sceneMesh(abut, state.mesh);
        const mesh = meshDataOf(shape);
        field?.dispose();
        const start = performance.now();
        field = abut.Field3.bake(shape, { cell: state.cell3, dense: true, gradients: state.gradients });
        milliseconds = performance.now() - start;
        shape.dispose();
        shader.set(abut, field);
        rightShader.set(abut, field);
        show(mesh);
        return field;
    }
    function show(mesh: MeshData): void {
        const { min, max, longest } = boxOf(mesh);
        cutMesh?.dispose();
        litMesh?.dispose();
        cutMesh = new SolidMesh(mesh);
        surface = refined(mesh, longest / 24);
        litMesh = new SolidMesh(surface);
        left.scene.add(cutMesh.object);
        right.scene.add(litMesh.object);
        const height = (min[1] ?? 0) - 0.5;
        left.fit(min, max);
        right.fit([-floorHalf, height, -floorHalf], [floorHalf, 2, floorHalf]);
        floor.height = height;
        if (particles) {
            particles.floor = height;
            particles.restart();
        }
        shone = "";
    }
    /** Points a cell above the surface, which the field rounds off by less than that. */
    function lifted(own: InstanceType<typeof abut.Field3>, points: Float32Array): Float32Array {
        const { normal } = own.sample_many(points) as { normal: Float32Array };
        const height = own.cell();
        return points.map((x, i) => x + height * (normal[i] ?? 0));
    }
    /** The light on the mesh by the processor, that on the floor by the graphics card. */
    function shine(own: InstanceType<typeof abut.Field3>): void {
        const wanted = JSON.stringify([baked, state.lamp3, state.softness]);
        if (!surface || wanted === shone) return;
        shone = wanted;
        litMesh?.setValues(own.shadow_many(lifted(own, surface.points), state.lamp3 as Point, state.softness));
        floor.shine(right.renderer, state.lamp3, state.softness);
    }

    function draw(): void {
        palette.refresh();
        // While particles fall, nothing else changes in most frames.
        const wanted = JSON.stringify([state, palette.css("back")]);
        if (wanted === drawn) return drawRight();
        drawn = wanted;
        const own = bake();
        if (particles) particles.count = state.particles;
        shine(own);
        setColors();
        placeSlice(own);
        const probe = state.probe3 as Point;
        const sample = {
            ...own.sample(probe),
            closest: own.closest(probe),
            light: own.shadow(probe, state.lamp3 as Point, state.softness),
        };
        answer = sample;
        left.draw([probeHandle(state.probe3, changed)], (drawing) => drawSample(drawing, probe, sample));
        drawRight();
        showSample(panel, answer);
        panel.answer("baked in", `${readable(milliseconds)} ms, a texture of ${readable(shader.bytes / 1e6)} MB`);
        if (!particles) panel.answer("particles", "this graphics card can't write the textures that they need");
    }
    function drawRight(): void {
        right.draw([lampHandle(state.lamp3, changed)], (drawing) => drawing.point(state.lamp3, { color: "mark", width: 6, onTop: true }));
    }
    function setColors(): void {
        const darker = ([red, green, blue]: [number, number, number]): [number, number, number] => [0.35 * red, 0.35 * green, 0.35 * blue];
        const [ground, body] = [palette.mixed("soft", "back", 0.5), palette.mixed("a", "back", 0.25)];
        slice.setColors(palette);
        cutMesh?.setColors(palette.mixed("a", "back", 0.35));
        litMesh?.setColors(darker(body), body);
        floor.setColors(darker(ground), ground);
        particles?.setColor(palette.rgb("b"));
    }
    /** The mesh is cut off on the viewer's side of the slice. */
    function placeSlice(own: InstanceType<typeof abut.Field3>): void {
        const axis = Math.max(Object.keys(axes).indexOf(state.axis), 0);
        const { min, max } = own.volume();
        const at = (min[axis] ?? 0) + state.slice * ((max[axis] ?? 0) - (min[axis] ?? 0));
        slice.place(axis, at, min, max);
        cutMesh?.setCut(
            [0, 1, 2].map((i) => (i === axis ? 1 : 0)),
            at,
        );
    }

    const lookup = (): string => (state.gradients ? ", .lookup = abut::FieldLookup::gradient" : "");
    return {
        draw,
        advance(seconds) {
            if (state.playing) particles?.step(Math.min(seconds, 1 / 30));
            return state.playing;
        },
        answers: () => ({ ...answer }),
        code: () => {
            const [cell, point, lamp, softness] = [
                cppFloat(state.cell3),
                cppVec(state.probe3),
                cppVec(state.lamp3),
                cppFloat(state.softness),
            ];
            return {
                cpp: [
                    "#include <abut/abut.hpp>\n#include <abut/bake.hpp>\n#include <abut/field/texture.hpp>\n",
                    `const abut::FieldOptions<3> options{.cell = ${cell}, .store = abut::FieldStore::dense${lookup()}};`,
                    "auto field = abut::bake_field(mesh, options);",
                    `auto sample = field->sample(${point});   // .distance, .normal`,
                    `auto on_surface = field->closest(${point});`,
                    `float light = field->shadow(${point}, ${lamp}, ${softness});`,
                    "auto texture = abut::to_texture(*field);   // for abut/field/abut_field.glsl",
                ].join("\n"),
                javascript: [
                    "const mesh = abut.Mesh(points, triangles);",
                    `const field = abut.Field3.bake(mesh, { cell: ${state.cell3}, dense: true, gradients: ${state.gradients} });`,
                    `const { distance, normal } = field.sample(${javascriptText(state.probe3)});`,
                    `const light = field.shadow(${javascriptText(state.probe3)}, ${javascriptText(state.lamp3)}, ${state.softness});`,
                ].join("\n"),
            };
        },
        dispose() {
            for (const one of [slice, floor, particles, cutMesh, litMesh, shader, rightShader]) one?.dispose();
            field?.dispose();
        },
    };
}
