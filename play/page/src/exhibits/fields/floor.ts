// A floor with the light that arrives on it: computed once for each change, as a texture.

import {
    BufferAttribute,
    BufferGeometry,
    DoubleSide,
    GLSL3,
    Mesh,
    RawShaderMaterial,
    Vector3,
    Vector4,
    WebGLRenderTarget,
    type WebGLRenderer,
} from "three";
import { ScreenPass } from "../../stage/screen_pass";
import { fieldFunctions, type FieldShader } from "./field_shader";

const texels = 192;

const lightFragment = `${fieldFunctions}
uniform vec4 area;
uniform vec3 lamp;
uniform float height, softness;
out vec4 color;
void main() {
    vec2 at = mix(area.xy, area.zw, gl_FragCoord.xy / ${texels.toFixed(1)});
    color = vec4(abut_shadow(vec3(at.x, height, at.y), lamp, softness), 0.0, 0.0, 1.0);
}`;
const vertex = `
uniform mat4 viewMatrix, projectionMatrix;
uniform vec4 area;
uniform float height;
in vec3 position;
out vec2 share;
void main() {
    share = position.xz;
    vec2 at = mix(area.xy, area.zw, share);
    gl_Position = projectionMatrix * viewMatrix * vec4(at.x, height, at.y, 1.0);
}`;
const fragment = `
precision highp float;
uniform sampler2D light;
uniform vec3 dark, lit;
in vec2 share;
out vec4 color;
void main() { color = vec4(mix(dark, lit, texture(light, share).r), 1.0); }`;

export class Floor {
    readonly object: Mesh;
    private readonly target = new WebGLRenderTarget(texels, texels, { depthBuffer: false });
    private readonly uniforms = {
        area: { value: new Vector4() },
        height: { value: 0 },
        lamp: { value: new Vector3() },
        softness: { value: 0 },
        light: { value: this.target.texture },
        dark: { value: new Vector3() },
        lit: { value: new Vector3() },
    };
    private readonly pass: ScreenPass;
    private readonly geometry = new BufferGeometry();
    private readonly material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: vertex,
        fragmentShader: fragment,
        uniforms: this.uniforms,
        side: DoubleSide,
        polygonOffset: true,
        polygonOffsetFactor: 2,
        polygonOffsetUnits: 2,
    });

    /** A square of 2 `half` around the origin. */
    constructor(field: FieldShader, half: number) {
        this.uniforms.area.value.set(-half, -half, half, half);
        // The pass must not read the texture that it writes.
        const { area, height, lamp, softness } = this.uniforms;
        this.pass = new ScreenPass(lightFragment, { ...field.uniforms, area, height, lamp, softness });
        this.geometry.setAttribute("position", new BufferAttribute(Float32Array.of(0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1), 3));
        this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
        this.object = new Mesh(this.geometry, this.material);
        this.object.frustumCulled = false;
    }
    set height(value: number) {
        this.uniforms.height.value = value;
    }
    setColors(dark: readonly [number, number, number], lit: readonly [number, number, number]): void {
        this.uniforms.dark.value.set(...dark);
        this.uniforms.lit.value.set(...lit);
    }
    /** Computes the light anew. */
    shine(renderer: WebGLRenderer, lamp: readonly number[], softness: number): void {
        this.uniforms.lamp.value.set(lamp[0] ?? 0, lamp[1] ?? 0, lamp[2] ?? 0);
        this.uniforms.softness.value = softness;
        this.pass.run(renderer, this.target);
    }
    dispose(): void {
        this.target.dispose();
        this.pass.dispose();
        this.geometry.dispose();
        this.material.dispose();
    }
}
