// A mesh that stays on the graphics card from frame to frame: flat faces, a colour or a value at each point, and a cut.

import { BufferAttribute, BufferGeometry, DoubleSide, GLSL3, Mesh, RawShaderMaterial, Vector3, Vector4 } from "three";
import type { MeshData } from "../shapes/mesh_data";

const vertex = `
uniform mat4 modelMatrix, viewMatrix, projectionMatrix;
in vec3 position;
in float value;
out vec3 place;
out float share;
void main() {
    place = (modelMatrix * vec4(position, 1.0)).xyz;
    share = value;
    gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
}`;
const fragment = `
precision highp float;
const vec3 light = vec3(0.348, 0.795, 0.497);
uniform vec3 low, high;
uniform vec4 cut;
in vec3 place;
in float share;
out vec4 color;
void main() {
    if (dot(cut.xyz, place) > cut.w) discard;
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    color = vec4(mix(low, high, clamp(share, 0.0, 1.0)) * (0.62 + 0.38 * abs(dot(normal, light))), 1.0);
}`;

type Color = readonly [number, number, number];

export class SolidMesh {
    readonly object: Mesh;
    private readonly geometry = new BufferGeometry();
    private readonly uniforms = {
        low: { value: new Vector3() },
        high: { value: new Vector3() },
        cut: { value: new Vector4(0, 0, 0, 1) },
    };
    private readonly material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: vertex,
        fragmentShader: fragment,
        uniforms: this.uniforms,
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
    });

    /** `values` from 0 to 1, one for each point: none is 0. */
    constructor({ points, triangles }: MeshData, values = new Float32Array(points.length / 3)) {
        this.geometry.setAttribute("position", new BufferAttribute(points, 3));
        this.geometry.setAttribute("value", new BufferAttribute(values, 1));
        this.geometry.setIndex(new BufferAttribute(triangles, 1));
        this.object = new Mesh(this.geometry, this.material);
        this.object.frustumCulled = false;
    }

    /** The colours of the values 0 and 1. */
    setColors(low: Color, high: Color = low): void {
        this.uniforms.low.value.set(...low);
        this.uniforms.high.value.set(...high);
    }
    setValues(values: Float32Array): void {
        this.geometry.setAttribute("value", new BufferAttribute(values, 1));
    }
    /** Hides what lies beyond a plane. */
    setCut(normal: readonly number[], offset: number): void {
        this.uniforms.cut.value.set(normal[0] ?? 0, normal[1] ?? 0, normal[2] ?? 0, offset);
    }
    dispose(): void {
        this.object.removeFromParent();
        this.geometry.dispose();
        this.material.dispose();
    }
}
