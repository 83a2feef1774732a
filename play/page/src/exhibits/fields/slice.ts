// A slice through a field: distances in two colours, with lines at even distances.

import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, Mesh, RawShaderMaterial, Vector3 } from "three";
import type { Numbers, Palette } from "../../stage/drawing";
import { fieldFunctions, type FieldShader } from "./field_shader";

const vertex = `
uniform mat4 viewMatrix, projectionMatrix;
in vec3 position;
out vec3 place;
void main() {
    place = position;
    gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}`;
const fragment = `${fieldFunctions}
uniform vec3 inside, outside, line, back;
uniform float spacing;
in vec3 place;
out vec4 color;
void main() {
    float away = abut_distance(place);
    float pixel = max(fwidth(away), 1e-6);
    float off = abs(fract(away / spacing + 0.5) - 0.5) * spacing;
    vec3 area = mix(back, away < 0.0 ? inside : outside, 0.25 + 0.5 * exp(-2.0 * abs(away)));
    area = mix(line, area, 0.65 + 0.35 * smoothstep(0.5, 1.5, off / pixel));
    color = vec4(mix(line, area, smoothstep(1.0, 2.0, abs(away) / pixel)), 1.0);
}`;

export class Slice {
    readonly object: Mesh;
    private readonly geometry = new BufferGeometry();
    private readonly material: RawShaderMaterial;
    private readonly colors = {
        inside: { value: new Vector3() },
        outside: { value: new Vector3() },
        line: { value: new Vector3() },
        back: { value: new Vector3() },
    };

    constructor(field: FieldShader, spacing: number) {
        const uniforms = { ...field.uniforms, ...this.colors, spacing: { value: spacing } };
        this.material = new RawShaderMaterial({
            glslVersion: GLSL3,
            vertexShader: vertex,
            fragmentShader: fragment,
            uniforms,
            side: DoubleSide,
        });
        this.geometry.setAttribute("position", new BufferAttribute(new Float32Array(12), 3));
        this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
        this.object = new Mesh(this.geometry, this.material);
        this.object.frustumCulled = false;
    }
    /** Across an axis, over a box. */
    place(axis: number, at: number, min: Numbers, max: Numbers): void {
        const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        const corners = [
            [min, min],
            [max, min],
            [max, max],
            [min, max],
        ] as const;
        const position = this.geometry.getAttribute("position") as BufferAttribute;
        corners.forEach(([first, second], i) => {
            position.setComponent(i, axis, at);
            position.setComponent(i, u, first[u] ?? 0);
            position.setComponent(i, v, second[v] ?? 0);
        });
        position.needsUpdate = true;
    }
    setColors(palette: Palette): void {
        this.colors.inside.value.set(...palette.rgb("a"));
        this.colors.outside.value.set(...palette.rgb("b"));
        this.colors.line.value.set(...palette.rgb("text"));
        this.colors.back.value.set(...palette.rgb("back"));
    }
    dispose(): void {
        this.geometry.dispose();
        this.material.dispose();
    }
}
