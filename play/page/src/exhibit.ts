// The interface of an exhibit: one idea of the library, to take in hand.

import type { Abut } from "./library";
import type { Panel } from "./panel/panel";
import type { Pane } from "./stage/pane";

/** A view on the stage. */
export interface PaneDescription {
    readonly title: string;
    readonly dimension: 2 | 3;
    /** The visible part at the start: its center and half of its smaller side, in world units. */
    readonly center?: readonly number[];
    readonly reach?: number;
}

/** What an exhibit is given. `State` is plain data, as it is stored in the link. */
export interface Context<State> {
    readonly abut: Abut;
    readonly state: State;
    readonly panel: Panel;
    /** One for each description, in its order. */
    readonly panes: readonly Pane[];
    /** The state has changed: redraws before the next refresh of the screen, and writes the link. */
    changed(): void;
    /** Starts the exhibit anew with the present state, when panes or controls have to change. */
    restart(): void;
}

/** An exhibit that runs. */
export interface Running {
    /** Resolves when the first answers are there, if that takes time; until then the page says that it loads. */
    readonly ready?: Promise<void>;
    /** Draws all panes and writes all answers. */
    draw(): void;
    /** Advances an animation by so many seconds, at most 1/20; returns true while it goes on. It is followed by `draw`. */
    advance?(seconds: number): boolean;
    /** The question that is asked, in both languages. */
    code(): { readonly cpp: string; readonly javascript: string };
    /** The numbers shown that follow from the state alone: no times, nothing of what moved before. For tests of the page. */
    answers?(): Readonly<Record<string, unknown>>;
    /** The state as a test in C++ that asserts the answer seen. */
    test?(): string;
    /** Frees what the exhibit owns. */
    dispose?(): void;
}

export interface Exhibit<State extends object> {
    /** What the answer means, in three sentences. */
    readonly meaning: string;
    readonly initial: State;
    panes(state: State): readonly PaneDescription[];
    start(context: Context<State>): Running;
}

/** Hides the type of the state, for the list of exhibits. */
export type AnyExhibit = Exhibit<any>;
