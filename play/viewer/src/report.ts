// The data of a report, as the tool writes them into the page.

/** Names in order of urgency. */
export const severities = ["error", "warning"] as const;
export type Severity = (typeof severities)[number];

/** A point, or a vector, of two or three numbers. */
export type Vector = readonly number[];

export interface Finding {
    /** Stays the same from run to run as long as the objects do: the link of the finding. */
    readonly id: string;
    readonly code: string;
    readonly kind: string;
    readonly severity: Severity;
    /** Names of the objects, or of the spawn. */
    readonly title: string;
    /** What was found, in one sentence. */
    readonly text: string;
    /** Indices of objects, one list for each name in the title. */
    readonly parties: readonly (readonly number[])[];
    readonly position: Vector;
    readonly points: readonly Vector[];
    /** From the first party to the second. */
    readonly normal?: Vector;
    readonly depth?: number;
    /** Seconds: the first, the last, and the time to show. */
    readonly time?: readonly [number, number, number];
}

/** Points are 16-bit numbers between the corners of the box `low`, `high`; all arrays are base64, little-endian. */
export interface MeshData {
    readonly low: Vector;
    readonly high: Vector;
    readonly points: string;
    /** Point numbers, 32 bits: three for each triangle, in 2D two for each line. */
    readonly elements: string;
    /** Only the elements near findings are there. */
    readonly partial?: boolean;
    /** In 2D: the lines enclose an area. */
    readonly filled?: boolean;
}

export interface SceneObject {
    readonly name: string;
    /** The corners of its box at the first time: low, then high. */
    readonly box: Vector;
    /** Its shape, if a finding is near; the box stands for others. */
    readonly mesh?: MeshData;
    /** For each sample its 12 numbers to the world, column by column, as 32-bit floats; one if it never moves. */
    readonly poses?: string;
}

export interface Report {
    readonly version: string;
    readonly file: string;
    readonly dimension: 2 | 3;
    readonly clean: boolean;
    readonly verdict: string;
    /** Lines of a label and a text. */
    readonly summary: readonly (readonly [string, string])[];
    readonly notes: readonly string[];
    /** Title and meaning of each kind of finding. */
    readonly kinds: Readonly<Record<string, string>>;
    /** Findings that are not on the page. */
    readonly left_out: number;
    readonly findings: readonly Finding[];
    readonly objects: readonly SceneObject[];
    /** Objects that are not on the page. */
    readonly objects_left_out: number;
    readonly up: Vector;
    /** Seconds of the samples of `poses`. */
    readonly samples: readonly number[];
}

/** The bytes of a base64 text. */
export function bytesOf(text: string): ArrayBuffer {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes.buffer;
}

/** Coordinates of all points of a mesh, one after the other. */
export function pointsOf(mesh: MeshData): Float32Array {
    const numbers = new Uint16Array(bytesOf(mesh.points));
    const dimension = mesh.low.length;
    const result = new Float32Array(numbers.length);
    for (let i = 0; i < numbers.length; ++i) {
        const low = mesh.low[i % dimension] ?? 0;
        const high = mesh.high[i % dimension] ?? 0;
        result[i] = low + ((high - low) * (numbers[i] ?? 0)) / 65535;
    }
    return result;
}

/** How much of the world a view of a finding shows: the radius of what it is about. */
export function radiusOf(report: Report, finding: Finding): number {
    const sizes = finding.parties.map((party) => {
        let squares = 0;
        for (const index of party) {
            const box = report.objects[index]?.box ?? [];
            const half = box.length / 2;
            let sum = 0;
            for (let i = 0; i < half; ++i) sum += ((box[half + i] ?? 0) - (box[i] ?? 0)) ** 2;
            squares = Math.max(squares, sum);
        }
        return Math.sqrt(squares) / 2;
    });
    let spread = 0;
    for (const point of finding.points)
        spread = Math.max(spread, Math.hypot(...point.map((x, i) => x - (finding.position[i] ?? 0))));
    const known = sizes.filter((size) => size > 0);
    const smaller = known.length > 0 ? Math.min(...known) : 1;
    // An object far larger than the place of the finding would hide it.
    return Math.max(1.2 * Math.min(smaller, 20 * (spread + (finding.depth ?? 0)) || smaller), 2 * spread, 1e-6);
}

/** What a pane needs of a view in space or in the plane. */
export interface View {
    readonly element: HTMLElement;
    show(finding: Finding | undefined): void;
    setTime(seconds: number): void;
    zoom(factor: number): void;
    /** Steps to the right and up. */
    turn(x: number, y: number): void;
    dispose(): void;
}

/** The colours of the first and the second party. */
export const partyColors = ["#2563eb", "#ea580c"] as const;
export const markColor = "#dc2626";

/** A label that lies over a view. */
export function label(text: string, className: string): HTMLSpanElement {
    const element = document.createElement("span");
    element.className = `label ${className}`;
    element.textContent = text;
    return element;
}

/** A number with four digits. */
export function rounded(value: number): string {
    return String(Number(value.toPrecision(4)));
}

/** The last name of a path. */
export function lastName(path: string): string {
    return path.slice(path.lastIndexOf("/") + 1);
}
