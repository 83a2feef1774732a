// Particles that fall on a surface and bounce, moved by the graphics card: two textures hold their places and velocities.

import {
    BufferGeometry,
    FloatType,
    GLSL3,
    NearestFilter,
    Points,
    RawShaderMaterial,
    Vector3,
    WebGLRenderTarget,
    type WebGLRenderer,
} from "three";
import { ScreenPass } from "../../stage/screen_pass";
import { fieldFunctions, type FieldShader } from "./field_shader";

const columns = 256;
export const maxParticles = 100_000;
const rows = Math.ceil(maxParticles / columns);

// A place has the time since it came in as its fourth number, a velocity how long the particle stays.
const moveFragment = `${fieldFunctions}
uniform highp sampler2D places, velocities;
uniform float seconds, height, half_size, seed;
layout(location = 0) out vec4 place;
layout(location = 1) out vec4 velocity;
const float radius = 0.012, bounce = 0.45, friction = 0.03;
// After Jarzynski and Olano, "Hash Functions for GPU Rendering" (2020): pcg4d.
vec4 random(uvec2 cell) {
    uvec4 v = uvec4(cell, uint(seed), 7u) * 1664525u + 1013904223u;
    for (int i = 0; i < 2; ++i) {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
        v ^= v >> 16u;
    }
    return vec4(v >> 8u) / 16777216.0;
}
void come_in() {
    vec4 share = random(uvec2(gl_FragCoord.xy));
    place = vec4((2.0 * share.x - 1.0) * 0.5 * half_size, 2.2 + 2.0 * share.y, (2.0 * share.z - 1.0) * 0.5 * half_size, 0.0);
    velocity = vec4(0.0, 0.0, 0.0, 2.0 + 5.0 * share.w);
}
void hit(vec3 normal, float away) {
    place.xyz -= normal * away;
    float into = min(dot(velocity.xyz, normal), 0.0);
    velocity.xyz = (velocity.xyz - (1.0 + bounce) * into * normal) * (1.0 - friction);
}
void main() {
    if (seconds == 0.0) {
        come_in();
        return;
    }
    place = texelFetch(places, ivec2(gl_FragCoord.xy), 0);
    velocity = texelFetch(velocities, ivec2(gl_FragCoord.xy), 0);
    velocity.y -= 4.0 * seconds;
    place += vec4(velocity.xyz, 1.0) * seconds;
    float away = abut_distance(place.xyz) - radius;
    if (away < 0.0) hit(abut_normal(place.xyz), away);
    float above = place.y - height - radius;
    if (above < 0.0 && above > -0.3 && all(lessThan(abs(place.xz), vec2(half_size)))) hit(vec3(0.0, 1.0, 0.0), above);
    if (place.w > velocity.w || place.y < height - 1.0) come_in();
}`;
const vertex = `
precision highp float;
uniform highp sampler2D places;
uniform mat4 viewMatrix, projectionMatrix;
uniform float size;
void main() {
    vec3 place = texelFetch(places, ivec2(gl_VertexID % ${columns}, gl_VertexID / ${columns}), 0).xyz;
    gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
    gl_PointSize = size;
}`;
const fragment = `
precision highp float;
uniform vec3 tint;
out vec4 color;
void main() { color = vec4(tint, 1.0); }`;

const makeTarget = (): WebGLRenderTarget =>
    new WebGLRenderTarget(columns, rows, {
        count: 2,
        type: FloatType,
        minFilter: NearestFilter,
        magFilter: NearestFilter,
        depthBuffer: false,
    });

export class Particles {
    readonly object: Points;
    private before = makeTarget();
    private after = makeTarget();
    private readonly uniforms = {
        places: { value: this.before.textures[0] },
        velocities: { value: this.before.textures[1] },
        seconds: { value: 0 },
        seed: { value: 0 },
        height: { value: 0 },
        half_size: { value: 1 },
    };
    private readonly shown = { places: { value: this.before.textures[0] }, size: { value: 2 }, tint: { value: new Vector3() } };
    private readonly pass: ScreenPass;
    private readonly geometry = new BufferGeometry();
    private readonly material = new RawShaderMaterial({
        glslVersion: GLSL3,
        vertexShader: vertex,
        fragmentShader: fragment,
        uniforms: this.shown,
    });

    /** They rest on a square floor of 2 `half`. */
    constructor(
        private readonly renderer: WebGLRenderer,
        field: FieldShader,
        half: number,
    ) {
        this.uniforms.half_size.value = half;
        this.pass = new ScreenPass(moveFragment, { ...field.uniforms, ...this.uniforms });
        this.object = new Points(this.geometry, this.material);
        this.object.frustumCulled = false;
    }

    /** Whether the graphics card can write numbers of 32 bits. */
    static canRun(renderer: WebGLRenderer): boolean {
        return renderer.extensions.has("EXT_color_buffer_float");
    }
    set floor(height: number) {
        this.uniforms.height.value = height;
    }
    set count(wanted: number) {
        const value = Math.min(Math.max(wanted, 0), maxParticles);
        this.geometry.setDrawRange(0, value);
        for (const target of [this.before, this.after]) {
            target.viewport.set(0, 0, columns, Math.ceil(value / columns));
            target.scissor.copy(target.viewport);
            target.scissorTest = true;
        }
    }
    setColor(tint: readonly [number, number, number]): void {
        this.shown.tint.value.set(...tint);
    }
    /** They come in anew, and fall for a moment. */
    restart(): void {
        this.step(0);
        for (let i = 0; i < 12; ++i) this.step(1 / 12);
    }
    /** Moves all of them on; by 0 seconds, they come in anew. */
    step(seconds: number): void {
        [this.before, this.after] = [this.after, this.before];
        this.uniforms.places.value = this.before.textures[0];
        this.uniforms.velocities.value = this.before.textures[1];
        this.uniforms.seconds.value = seconds;
        this.uniforms.seed.value += 1;
        this.pass.run(this.renderer, this.after);
        this.shown.places.value = this.after.textures[0];
    }
    dispose(): void {
        this.before.dispose();
        this.after.dispose();
        this.pass.dispose();
        this.geometry.dispose();
        this.material.dispose();
    }
}
