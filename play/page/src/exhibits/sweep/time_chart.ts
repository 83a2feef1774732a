// The signed distance of two moving shapes over the time of their motion, with the stops of the search.

import type { Drawing } from "../../stage/drawing";
import type { Stop } from "../../trace";

/** A time and a distance in the pane: time 0 is at -2, time 1 at 2. */
const place = (time: number, distance: number): [number, number] => [4 * time - 2, distance];

export interface Chart {
    /** At even times from 0 to 1. */
    readonly distances: Float32Array;
    readonly stops: readonly Stop[];
    readonly time: number;
    /** Of the hit, if there is one. */
    readonly impact: number | null;
}

export function drawTimeChart(drawing: Drawing, { distances, stops, time, impact }: Chart): void {
    const highest = Math.max(1, ...distances);
    drawing.line([...place(0, 0), ...place(1, 0)], { color: "text" });
    drawing.line([...place(0, 0), ...place(0, highest)], { color: "text" });
    drawing.line(
        Array.from(distances).flatMap((distance, i) => place(i / (distances.length - 1), distance)),
        { color: "accent", width: 2 },
    );
    for (const [i, stop] of stops.entries()) {
        const next = stops[i + 1];
        drawing.line([...place(stop.time, 0), ...place(stop.time, stop.distance)], { color: "good", dashed: true });
        // From a stop to the next one nothing touches.
        if (next) drawing.line([...place(stop.time, stop.distance), ...place(next.time, 0)], { color: "good" });
        drawing.point(place(stop.time, stop.distance), { color: "good", width: 2 });
    }
    drawing.line([...place(time, Math.min(0, ...distances)), ...place(time, highest)], { color: "soft" });
    if (impact !== null) drawing.point(place(impact, 0), { color: "mark", width: 4 });
    drawing.text(place(0, 0), "time 0", { color: "text" }, [0, -16]);
    drawing.text(place(1, 0), "time 1", { color: "text" }, [0, -16]);
    drawing.text(place(0, highest), "distance", { color: "text" }, [28, 14]);
}
