// Scene viewer: `abut check` on a scene of one's own, with the viewer of its report page.

import "../../../../viewer/src/parts.css";
import "./scene_viewer.css";

import { el } from "../../../../viewer/src/elements";
import { aboutOf, detailOf } from "../../../../viewer/src/finding_detail";
import { FindingList } from "../../../../viewer/src/finding_list";
import type { Finding, Report } from "../../../../viewer/src/report";
import { ScenePane } from "../../../../viewer/src/scene_pane";
import type { Context, Exhibit, Running } from "../../exhibit";
import { dropFiles } from "../../panel/drop";
import { Checker } from "./checker";
import type { SceneFile, Settings } from "./messages";
import { ProgressBar } from "./progress_bar";
import { load, samples } from "./samples";

interface State {
    sample: string;
    allow: string;
    clearance: string;
    /** The id of a finding. */
    selected: string;
}

const sceneEndings = [".gltf", ".glb", ".tmj", ".tmx", ".svg", ".svgz", ".json"];
const otherEndings = [".bin", ".tsj", ".tsx", ".tj", ".tx"];
const maxBytes = 64e6;
/** In units of the scene. */
const lengths = { "0.01": "0.01", "0.1": "0.1", "1.0": "1", "10.0": "10" };

export const sceneViewer: Exhibit<State> = {
    meaning:
        "The check takes each object of a scene as a solid or a surface, moves it through the animation, and reports every pair that " +
        "overlaps deeper than allowed, with where, how deep and when. It is the code of `abut check`, run on your files in this page: " +
        "nothing is uploaded, and `abut check --report` writes the same view as a page of its own. Files compressed by Draco, scenes " +
        "of Godot, and formats other than glTF, Tiled and SVG are left to the tool.",
    initial: { sample: "level", allow: "default", clearance: "none", selected: "" },
    panes: () => [{ title: "Scene", dimension: 2 }],
    start,
};

/** A report on the stage and in the panel. */
class Shown {
    readonly onStage: HTMLElement;
    readonly inPanel: HTMLElement;
    finding: Finding | undefined;
    private readonly list: FindingList;
    private readonly scene: ScenePane;
    private readonly detail = el("section", { class: "detail", "aria-live": "polite" });

    constructor(
        readonly report: Report,
        private readonly onSelect: (finding: Finding) => void,
    ) {
        this.list = new FindingList(report, (finding) => this.select(finding));
        this.scene = new ScenePane(report, (finding) => this.select(finding));
        this.onStage = el("div", { class: "report stage" }, ...this.scene.elements);
        const verdict = el("p", { class: report.clean ? "verdict clean" : "verdict" }, report.verdict);
        this.inPanel = el("div", { class: "report" }, verdict, aboutOf(report));
        if (!report.clean) this.inPanel.append(this.list.element, this.detail);
        // The pane below has handles and a view of its own.
        for (const name of ["pointerdown", "wheel", "keydown"] as const)
            this.onStage.addEventListener(name, (event) => event.stopPropagation());
    }

    /** The finding with an id, or else the first one, once the elements are on the page. */
    selectById(id: string): void {
        const finding = this.report.findings.find((one) => one.id === id);
        if (finding) this.select(finding);
        else this.list.step(1);
    }
    dispose(): void {
        this.scene.dispose();
        this.onStage.remove();
        this.inPanel.remove();
    }

    private select(finding: Finding): void {
        this.finding = finding;
        this.list.mark(finding);
        this.scene.show(finding);
        this.detail.replaceChildren(...detailOf(this.report, finding, el("span", { class: "code" }, finding.code)));
        this.onSelect(finding);
    }
}

/** A scene with the files that it refers to, and the options that it came with. */
interface Job {
    readonly files: readonly SceneFile[];
    readonly scene: string;
    readonly settings: Settings;
}

function start({ state, panel, panes, changed }: Context<State>): Running {
    const pane = panes[0] as (typeof panes)[0];
    const checker = new Checker();
    const progress = new ProgressBar(() => {
        job = shownJob;
        checker.stop();
        progress.end("The check was stopped.");
    });
    const place = el("div", {});
    let shown: Shown | undefined;
    let shownJob: Job | undefined;
    /** The latest one, which may still run. */
    let job: Job | undefined;
    let isOver = false;

    const settingsOf = ({ settings }: Job): Settings => ({
        ...settings,
        ...(state.allow === "default" ? {} : { allow: [state.allow === "none" ? "0" : state.allow] }),
        ...(state.clearance === "none" ? {} : { clearance: [state.clearance] }),
    });

    /** Checks a scene, and shows the report; what was shown before stays if that fails, or if another check begins. */
    async function check(newJob: Job): Promise<void> {
        job = newJob;
        const isLatest = (): boolean => job === newJob && !isOver;
        progress.start(newJob.scene);
        try {
            const report = await checker.check(newJob.files, newJob.scene, settingsOf(newJob), (one) => progress.show(one));
            if (isLatest()) show(report);
        } catch (error) {
            if (!isLatest()) return;
            job = shownJob;
            progress.end();
            throw error;
        }
    }
    function show(report: Report): void {
        progress.end();
        shown?.dispose();
        shownJob = job;
        shown = new Shown(report, (finding) => {
            state.selected = finding.id;
            changed();
        });
        pane.element.append(shown.onStage);
        place.append(shown.inPanel);
        shown.selectById(state.selected);
        changed();
    }
    /** The sentence of a failure stands beside the bar. */
    async function checkHere(run: () => Promise<void>): Promise<void> {
        try {
            await run();
        } catch (error) {
            if (!isOver) progress.end(error instanceof Error ? error.message : String(error));
        }
    }
    const checkSample = (): Promise<void> =>
        checkHere(async () => {
            const sample = samples[state.sample] ?? samples["level"];
            if (sample) await check({ files: await load(sample), scene: sample.files[0]?.[0] ?? "", settings: sample.settings });
        });
    const checkAgain = (): void => void checkHere(async () => (job ? check({ ...job }) : checkSample()));

    const titles = Object.fromEntries(Object.entries(samples).map(([id, { title }]) => [id, title]));
    panel.choice("Sample", titles, () => state.sample, (sample) => {
        state.sample = sample;
        void checkSample();
    });
    panel.choice("Depth allowed", { default: "1/1000 of the object", none: "none", ...lengths }, () => state.allow, (allow) => {
        state.allow = allow;
        checkAgain();
    });
    panel.choice("Clearance", { none: "none", ...lengths }, () => state.clearance, (clearance) => {
        state.clearance = clearance;
        checkAgain();
    });
    panel.insert(progress.element);
    panel.insert(progress.note);
    const button = dropFiles(panel, pane, [...sceneEndings, ...otherEndings].join(","), maxBytes, async (dropped) => {
        const ofEnding = (ending: string): File[] => dropped.filter((file) => file.name.toLowerCase().endsWith(ending));
        const main = sceneEndings.flatMap(ofEnding)[0];
        if (!main) throw new Error("Among these files is no scene: a .gltf, .glb, .tmj, .tmx or .svg.");
        const files = await Promise.all(
            dropped.map(async (file) => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) })),
        );
        await check({ files, scene: main.name, settings: {} });
    });
    // Above the findings, which may be many.
    panel.insert(el("div", { class: "actions" }, button));
    panel.insert(place);

    return {
        ready: checkSample(),
        draw: () => {},
        answers: () => ({
            file: shown?.report.file,
            verdict: shown?.report.verdict,
            findings: shown?.report.findings.length,
            objects: shown?.report.objects.length,
            selected: shown?.finding?.id,
            depth: shown?.finding?.depth,
        }),
        code: () => codeOf(shownJob?.scene ?? "level.gltf", shownJob ? settingsOf(shownJob) : {}),
        dispose: () => {
            isOver = true;
            checker.dispose();
            shown?.dispose();
        },
    };
}

/** The same check by the tool. */
function codeOf(scene: string, settings: Settings): { cpp: string; javascript: string } {
    const options = Object.entries(settings).flatMap(([name, values]) => values.flatMap((value) => [`--${name}`, value]));
    const [type, read] = /\.(gltf|glb)$/i.test(scene) ? ["Scene", "read_scene"] : ["Level", "read_level"];
    const cpp = [
        "// The tool does what this page does:",
        `//     abut check ${[scene, ...options].join(" ")} --report report.html`,
        "#include <abut/io.hpp>",
        "",
        `abut::Result<abut::${type}> scene = abut::${read}("${scene}");`,
    ];
    const javascript = [
        "// A step of a build, which fails where something is found:",
        'import { execFileSync } from "node:child_process";',
        `execFileSync("abut", ${JSON.stringify(["check", scene, ...options])});`,
    ];
    return { cpp: cpp.join("\n"), javascript: javascript.join("\n") };
}
