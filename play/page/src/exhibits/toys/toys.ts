// Toys: small games on the library. Each is an exhibit of its own; this one has the choice among them.

import type { AnyExhibit, Exhibit } from "../../exhibit";
import { bullet } from "./bullet";
import { lag } from "./lag";
import { laser } from "./laser";
import { pick } from "./pick";
import { platformer } from "./platformer";
import { walker } from "./walker";

const entries: Readonly<Record<string, { readonly title: string; readonly exhibit: AnyExhibit }>> = {
    laser: { title: "Laser and mirrors", exhibit: laser },
    platformer: { title: "Platformer", exhibit: platformer },
    walker: { title: "First-person walker", exhibit: walker },
    pick: { title: "Click on shapes", exhibit: pick },
    bullet: { title: "A fast bullet", exhibit: bullet },
    lag: { title: "Lag compensation", exhibit: lag },
};

/** The toy, and the state of each under its name. */
interface State {
    toy: string;
    [name: string]: unknown;
}

const toyOf = (state: State): string => (state.toy in entries ? state.toy : "laser");
const exhibitOf = (state: State): AnyExhibit => entries[toyOf(state)]?.exhibit ?? laser;

export const toys: Exhibit<State> = {
    meaning: laser.meaning,
    initial: { toy: "laser", ...Object.fromEntries(Object.entries(entries).map(([name, { exhibit }]) => [name, exhibit.initial])) },
    panes: (state) => exhibitOf(state).panes(state[toyOf(state)]),
    start(context) {
        const { state, panel, restart } = context;
        const exhibit = exhibitOf(state);
        panel.setMeaning(exhibit.meaning);
        const titles = Object.fromEntries(Object.entries(entries).map(([name, { title }]) => [name, title]));
        panel.choice(
            "Toy",
            titles,
            () => toyOf(state),
            (toy) => {
                state.toy = toy;
                restart();
            },
        );
        return exhibit.start({ ...context, state: state[toyOf(state)] });
    },
};
