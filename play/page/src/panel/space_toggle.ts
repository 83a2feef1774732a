// The control by which an exhibit goes from the plane to space, where it has other panes and shapes.

import type { Context } from "../exhibit";

export function spaceToggle<State extends { space: boolean }>({ panel, state, restart }: Context<State>): void {
    panel.toggle(
        "In space",
        () => state.space,
        (value) => {
            state.space = value;
            restart();
        },
    );
}
