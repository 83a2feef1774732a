/** The nearest number in a range, for members of a link that may be anything. */
export function within(value: number, min: number, max: number): number {
    return Math.min(Math.max(value, min), max);
}
