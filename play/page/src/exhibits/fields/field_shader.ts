// A field on the graphics card: its texture, and the library's functions for shaders.

import { Data3DTexture, HalfFloatType, LinearFilter, RedFormat, Vector2, Vector3, type IUniform } from "three";
import source from "abut/abut_field.glsl?raw";
import type { Abut } from "../../library";

/** Before the code of a fragment shader: abut_distance, abut_normal and abut_shadow. The hardware interpolates. */
export const fieldFunctions = `#define ABUT_FIELD_FILTER\n#define ABUT_SHADOW_STEPS 64\n${source}`;

/** Numbers before the texels that play/wasm/field_texture.h describes. */
const headerLength = 16;

/** The uniforms of the library's functions. They are the same objects for all shaders, and `set` changes them. */
export class FieldShader {
    readonly uniforms = {
        abut_texture: { value: new Data3DTexture() },
        abut_origin: { value: new Vector3() },
        abut_cell: { value: 1 },
        abut_decode: { value: new Vector2() },
        abut_surface_min: { value: new Vector3() },
        abut_surface_max: { value: new Vector3() },
    } satisfies Record<string, IUniform>;
    /** Of the texture. */
    bytes = 0;

    set(abut: Abut, field: InstanceType<Abut["Field3"]>): void {
        const { buffer, byteOffset, byteLength } = abut.play_field_texture(field, 0);
        const header = new Float32Array(buffer, byteOffset, headerLength);
        const at = (i: number): number => header[i] ?? 0;
        const texels = new Uint16Array(buffer, byteOffset + 4 * headerLength, byteLength / 2 - 2 * headerLength);
        const texture = new Data3DTexture(texels as Uint16Array<ArrayBuffer>, at(0), at(1), at(2));
        texture.format = RedFormat;
        texture.type = HalfFloatType;
        texture.minFilter = texture.magFilter = LinearFilter;
        texture.unpackAlignment = 1;
        texture.needsUpdate = true;
        this.dispose();
        this.bytes = texels.byteLength;
        this.uniforms.abut_texture.value = texture;
        this.uniforms.abut_decode.value.set(at(3), at(4));
        this.uniforms.abut_cell.value = at(6);
        this.uniforms.abut_origin.value.set(at(7), at(8), at(9));
        this.uniforms.abut_surface_min.value.set(at(10), at(11), at(12));
        this.uniforms.abut_surface_max.value.set(at(13), at(14), at(15));
    }
    dispose(): void {
        this.uniforms.abut_texture.value.dispose();
    }
}
