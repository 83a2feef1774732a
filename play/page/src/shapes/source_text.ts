// Shapes and numbers as source text that reads as the same floats.

/** A plain shape of the npm package; which members there are depends on the type. */
export interface PlainShape {
    readonly type: string;
    readonly [member: string]: unknown;
}

function shortest(value: number): number {
    return Number(Math.fround(value).toPrecision(9));
}

export function cppFloat(value: number): string {
    const text = shortest(value).toString();
    return /[.e]/.test(text) ? `${text}f` : `${text}.f`;
}
export function cppVec(values: ArrayLike<number>): string {
    return `{${Array.from(values, cppFloat).join(", ")}}`;
}
/** A Turn of cosine and sine, or a quaternion x y z w. */
export function cppRotation(values: ArrayLike<number>): string {
    return values.length === 2
        ? `abut::Turn${cppVec(values)}`
        : `glm::quat(${[3, 0, 1, 2].map((i) => cppFloat(values[i] ?? 0)).join(", ")})`;
}
export function cppPose({ position, rotation }: { position: readonly number[]; rotation: readonly number[] }): string {
    return `{${cppVec(position)}, ${cppRotation(rotation)}}`;
}

/** An expression in C++. */
export function cppShape(shape: PlainShape): string {
    const number = (name: string): string => cppFloat(shape[name] as number);
    const vec = (name: string): string => cppVec(shape[name] as number[]);
    const inner = (): string => cppShape(shape["shape"] as PlainShape);
    switch (shape.type) {
        case "ball2":
            return `abut::Circle{${vec("center")}, ${number("radius")}}`;
        case "ball3":
            return `abut::Sphere{${vec("center")}, ${number("radius")}}`;
        case "box2":
            return `abut::Box2{${vec("center")}, ${vec("half")}}`;
        case "box3":
            return `abut::Box3{${vec("center")}, ${vec("half")}}`;
        case "capsule2":
            return `abut::Capsule2{${vec("a")}, ${vec("b")}, ${number("radius")}}`;
        case "capsule3":
            return `abut::Capsule3{${vec("a")}, ${vec("b")}, ${number("radius")}}`;
        case "segment2":
            return `abut::Segment2{${vec("a")}, ${vec("b")}}`;
        case "cylinder":
            return `abut::Cylinder{${vec("a")}, ${vec("b")}, ${number("radius")}}`;
        case "cone":
            return `abut::Cone{${vec("a")}, ${vec("b")}, ${number("radius")}}`;
        case "polygon":
            return `*abut::Polygon::build(${cppPoints(shape["points"] as number[], 2)})`;
        case "polyhedron":
            return `*abut::Polyhedron::build(${cppPoints(shape["points"] as number[], 3)})`;
        case "at":
            return `abut::at(${inner()}, ${cppPose(shape["pose"] as { position: number[]; rotation: number[] })})`;
        case "rounded":
            return `abut::rounded(${inner()}, ${number("radius")})`;
        case "stretched":
            return `abut::stretched(${inner()}, ${cppVec(shape["scale"] as number[])})`;
        default:
            throw new TypeError(`no text for a shape of type ${shape.type}`);
    }
}
/** Points by flat numbers. */
export function cppPoints(numbers: readonly number[], dimension: number): string {
    const points = Array.from({ length: numbers.length / dimension }, (_, i) => cppVec(numbers.slice(i * dimension, (i + 1) * dimension)));
    return `std::vector<abut::Vec${dimension}>{${points.join(", ")}}`;
}

/** Plain data in JavaScript. */
export function javascriptText(value: unknown): string {
    const text = JSON.stringify(value, (_, one: unknown) => (typeof one === "number" ? shortest(one) : one));
    return text.replace(/"([a-z_]+)":/g, "$1: ").replace(/,/g, ", ");
}

/** A complete test in C++ of lines. */
export function cppTest(name: string, lines: readonly string[], headers: readonly string[] = []): string {
    const body = lines.map((line) => `    ${line}`);
    return ["#include <abut/abut.hpp>", ...headers.map((header) => `#include <${header}>`), "#include <gtest/gtest.h>", "", `TEST(Playground, ${name}) {`, ...body, "}", ""].join("\n");
}
/** Lines of a test: that an expression has the value seen. */
export function expectFloat(expression: string, value: number): string {
    return `EXPECT_FLOAT_EQ(${expression}, ${cppFloat(value)});`;
}
export function expectVec(expression: string, values: ArrayLike<number>): string[] {
    return Array.from(values, (value, i) => expectFloat(`${expression}.${"xyz".charAt(i)}`, value));
}
