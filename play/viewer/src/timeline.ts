// The time of an animated scene: a slider, and above it when each finding lasts.

import { rounded, type Finding, type Report } from "./report";

export class Timeline {
    readonly element = document.createElement("div");
    private readonly slider = document.createElement("input");
    private readonly time = document.createElement("output");
    private readonly play = document.createElement("button");
    private readonly marks = document.createElement("div");
    private readonly first: number;
    private readonly last: number;
    private started: { at: number; from: number } | undefined;

    constructor(
        report: Report,
        private readonly onTime: (seconds: number) => void,
        onFinding: (finding: Finding) => void,
    ) {
        this.first = report.samples[0] ?? 0;
        this.last = report.samples.at(-1) ?? 0;
        this.element.className = "timeline";
        this.marks.className = "spans";
        this.play.type = "button";
        this.slider.type = "range";
        this.slider.min = String(this.first);
        this.slider.max = String(this.last);
        this.slider.step = "any";
        this.slider.setAttribute("aria-label", "Time in seconds");
        this.slider.addEventListener("input", () => {
            this.stop();
            this.set(Number(this.slider.value));
            this.onTime(Number(this.slider.value));
        });
        this.play.addEventListener("click", () => (this.started ? this.stop() : this.start()));
        for (const finding of report.findings) {
            if (!finding.time) continue;
            const span = document.createElement("span");
            span.className = `span ${finding.severity}`;
            span.dataset["id"] = finding.id;
            span.title = finding.title;
            span.style.left = `${this.percent(finding.time[0])}%`;
            span.style.width = `${this.percent(finding.time[1]) - this.percent(finding.time[0])}%`;
            span.addEventListener("click", () => onFinding(finding));
            this.marks.append(span);
        }
        const track = document.createElement("div");
        track.className = "track";
        track.append(this.marks, this.slider);
        this.element.append(this.play, track, this.time);
        this.stop();
        this.set(this.first);
    }

    set(seconds: number): void {
        this.slider.value = String(seconds);
        this.time.value = `${rounded(seconds)} s`;
    }

    /** Stops, goes to the time of a finding and marks it. */
    show(finding: Finding): void {
        this.stop();
        for (const span of this.marks.children)
            span.classList.toggle("selected", (span as HTMLElement).dataset["id"] === finding.id);
        const seconds = finding.time?.[2] ?? this.first;
        this.set(seconds);
        this.onTime(seconds);
    }

    private percent(seconds: number): number {
        return (100 * (seconds - this.first)) / (this.last - this.first);
    }

    private start(): void {
        const from = Number(this.slider.value);
        this.started = { at: performance.now(), from: from < this.last ? from : this.first };
        this.play.textContent = "❚❚";
        this.play.setAttribute("aria-label", "Stop");
        requestAnimationFrame(() => this.step());
    }

    stop(): void {
        this.started = undefined;
        this.play.textContent = "▶";
        this.play.setAttribute("aria-label", "Play");
    }

    private step(): void {
        if (!this.started) return;
        const seconds = this.started.from + (performance.now() - this.started.at) / 1000;
        this.set(Math.min(seconds, this.last));
        this.onTime(Math.min(seconds, this.last));
        if (seconds < this.last) requestAnimationFrame(() => this.step());
        else this.stop();
    }
}
