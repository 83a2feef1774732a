// Numbers that grow as a frame is drawn, and go to the graphics card as one thing.

import { BufferAttribute, BufferGeometry, DynamicDrawUsage, type Material, type Object3D } from "three";

export class Batch {
    private positions = new Float32Array(3 * 256);
    private colors = new Float32Array(4 * 256);
    private count = 0;
    private readonly geometry = new BufferGeometry();
    readonly object: Object3D;

    constructor(
        make: (geometry: BufferGeometry, material: Material) => Object3D,
        private readonly material: Material,
        order: number,
    ) {
        this.object = make(this.geometry, material);
        this.object.frustumCulled = false;
        this.object.renderOrder = order;
    }

    clear(): void {
        this.count = 0;
    }
    add(x: number, y: number, z: number, red: number, green: number, blue: number, alpha: number): void {
        if (3 * this.count === this.positions.length) this.grow();
        const [position, color] = [3 * this.count, 4 * this.count];
        this.positions[position] = x;
        this.positions[position + 1] = y;
        this.positions[position + 2] = z;
        this.colors[color] = red;
        this.colors[color + 1] = green;
        this.colors[color + 2] = blue;
        this.colors[color + 3] = alpha;
        ++this.count;
    }
    /** Hands over what was added since `clear`. */
    upload(): void {
        const before = this.geometry.getAttribute("position") as BufferAttribute | undefined;
        if (before?.array !== this.positions) {
            this.geometry.dispose();
            this.geometry.setAttribute("position", new BufferAttribute(this.positions, 3).setUsage(DynamicDrawUsage));
            this.geometry.setAttribute("color", new BufferAttribute(this.colors, 4).setUsage(DynamicDrawUsage));
        }
        this.geometry.setDrawRange(0, this.count);
        this.object.visible = this.count > 0;
        if (this.count === 0) return;
        for (const name of ["position", "color"]) {
            const attribute = this.geometry.getAttribute(name) as BufferAttribute;
            attribute.clearUpdateRanges();
            attribute.addUpdateRange(0, this.count * attribute.itemSize);
            attribute.needsUpdate = true;
        }
    }
    dispose(): void {
        this.geometry.dispose();
        this.material.dispose();
    }

    private grow(): void {
        const grown = <T extends Float32Array>(old: T): Float32Array<ArrayBuffer> => {
            const result = new Float32Array(2 * old.length);
            result.set(old);
            return result;
        };
        this.positions = grown(this.positions);
        this.colors = grown(this.colors);
    }
}
