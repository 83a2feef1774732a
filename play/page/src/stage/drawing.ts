// What can be drawn in a pane, in world coordinates. Points are flat numbers: x y x y ... or x y z x y z ...

export type Numbers = ArrayLike<number>;

/** Colours by what they mean; style sheets say how they look, light and dark. */
export type ColorName = "a" | "b" | "mark" | "good" | "bad" | "soft" | "grid" | "text" | "accent";

export interface Style {
    readonly color: ColorName;
    /** Of lines, in pixels; 0 for none. */
    readonly width?: number;
    /** The opacity of areas, from 0 to 1. */
    readonly fill?: number;
    readonly dashed?: boolean;
    /** The opacity of lines and points, from 0 to 1. */
    readonly alpha?: number;
    /** Over everything else. */
    readonly onTop?: boolean;
}

export interface Drawing {
    readonly dimension: 2 | 3;
    /** A line through points. */
    line(points: Numbers, style: Style): void;
    /** A line for each two points. */
    segments(points: Numbers, style: Style): void;
    /** A closed, convex and flat line, and its area. */
    polygon(points: Numbers, style: Style): void;
    /** Triangles by three indices each; areas without lines. */
    triangles(points: Numbers, indices: Numbers, style: Style): void;
    /** A mark of readable size. */
    point(at: Numbers, style: Style): void;
    arrow(from: Numbers, to: Numbers, style: Style): void;
    /** `shift`: to the right and up, in pixels. */
    text(at: Numbers, text: string, style: Style, shift?: readonly [number, number]): void;
    /** What the library draws by itself: the output of a function abut_play_draw. */
    commands(commands: Float32Array, style: Style): void;
}

/** Calls of abut's own Canvas, one after the other: an operation, a number of points, and the points. */
const enum Operation {
    line = 1,
    point = 2,
    polygon = 3,
    filled = 4,
    faint = 5,
}

/** Draws what a function of play/wasm wrote. Areas are filled by the style's opacity, or by a quarter where it has none; faint ones by
 * half of it. */
export function replay(drawing: Drawing, commands: Float32Array, style: Style): void {
    const lineStyle: Style = { ...style, fill: 0 };
    const fillStyle: Style = { ...style, fill: style.fill ?? 0.25 };
    const faintStyle: Style = { ...style, fill: 0.5 * (style.fill ?? 0.25) };
    eachCommand(commands, drawing.dimension, (operation, points) => {
        if (operation === Operation.line) drawing.segments(points, lineStyle);
        else if (operation === Operation.point) drawing.point(points, lineStyle);
        else drawing.polygon(points, operation === Operation.filled ? fillStyle : operation === Operation.faint ? faintStyle : lineStyle);
    });
}

/** The areas among what a function of play/wasm wrote. */
export function areasOf(commands: Float32Array, dimension: 2 | 3): { points: Float32Array; isFaint: boolean }[] {
    const areas: { points: Float32Array; isFaint: boolean }[] = [];
    eachCommand(commands, dimension, (operation, points) => {
        if (operation === Operation.filled || operation === Operation.faint) areas.push({ points, isFaint: operation === Operation.faint });
    });
    return areas;
}

function eachCommand(commands: Float32Array, dimension: 2 | 3, visit: (operation: number, points: Float32Array) => void): void {
    let next = 0;
    while (next + 1 < commands.length) {
        const end = next + 2 + (commands[next + 1] ?? 0) * dimension;
        visit(commands[next] ?? 0, commands.subarray(next + 2, end));
        next = end;
    }
}

/** The colours of the style sheet at present. */
export class Palette {
    private readonly colors = new Map<string, string>();
    private readonly numbers = new Map<string, readonly [number, number, number]>();

    constructor(private readonly element: Element) {
        this.refresh();
    }
    refresh(): void {
        const style = getComputedStyle(this.element);
        for (const name of ["a", "b", "mark", "good", "bad", "soft", "grid", "text", "accent", "back"]) {
            const css = style.getPropertyValue(`--${name}`).trim() || unknown;
            this.colors.set(name, css);
            this.numbers.set(name, rgbOf(css));
        }
    }
    css(name: ColorName | "back"): string {
        return this.colors.get(name) ?? unknown;
    }
    /** Red, green and blue from 0 to 1. */
    rgb(name: ColorName | "back"): readonly [number, number, number] {
        return this.numbers.get(name) ?? rgbOf(unknown);
    }
    /** A colour between two. */
    mixed(from: ColorName | "back", to: ColorName | "back", share: number): [number, number, number] {
        const [first, second] = [this.rgb(from), this.rgb(to)];
        const mix = (i: 0 | 1 | 2): number => (1 - share) * first[i] + share * second[i];
        return [mix(0), mix(1), mix(2)];
    }
}

const unknown = "#888888";
/** Colours are written as #rrggbb, or as #rgb in a style sheet that was made smaller. */
function rgbOf(css: string): readonly [number, number, number] {
    const digits = css.length === 4 ? css.slice(1).replace(/./g, "$&$&") : css.slice(1);
    const value = Number.parseInt(digits, 16);
    return [((value >> 16) & 255) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}
