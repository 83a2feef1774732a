// A fragment shader run for every texel of a render target.

import {
    BufferAttribute,
    BufferGeometry,
    Camera,
    GLSL3,
    Mesh,
    RawShaderMaterial,
    Scene,
    type IUniform,
    type WebGLRenderer,
    type WebGLRenderTarget,
} from "three";

const vertex = `
in vec3 position;
void main() { gl_Position = vec4(position, 1.0); }`;

export class ScreenPass {
    private readonly scene = new Scene();
    private readonly camera = new Camera();
    private readonly geometry = new BufferGeometry();
    private readonly material: RawShaderMaterial;

    constructor(fragmentShader: string, uniforms: Record<string, IUniform>) {
        this.material = new RawShaderMaterial({
            glslVersion: GLSL3,
            vertexShader: vertex,
            fragmentShader,
            uniforms,
            depthTest: false,
            depthWrite: false,
        });
        // One triangle that covers the screen.
        this.geometry.setAttribute("position", new BufferAttribute(Float32Array.of(-1, -1, 0, 3, -1, 0, -1, 3, 0), 3));
        const triangle = new Mesh(this.geometry, this.material);
        triangle.frustumCulled = false;
        this.scene.add(triangle);
    }
    run(renderer: WebGLRenderer, target: WebGLRenderTarget): void {
        renderer.setRenderTarget(target);
        renderer.render(this.scene, this.camera);
        renderer.setRenderTarget(null);
    }
    dispose(): void {
        this.geometry.dispose();
        this.material.dispose();
    }
}
