// The questions in both languages.

interface Code {
    readonly cpp: string;
    readonly javascript: string;
}

export function walkCode(isPath: boolean, start: readonly number[]): Code {
    const cpp = isPath
        ? ["auto path = level->find_path(hero, goal);", "// path->points, path->places, path->length"]
        : [
              "abut::Walked walked = level->walk(hero, step);",
              "hero = walked.place;                      // triangle and weights",
              "forward = walked.turn * forward;          // its frame is carried along",
              "// walked.met, walked.length, walked.lost, walked.crossings",
          ];
    const javascript = isPath
        ? ["const path = level.path(hero, goal);", "// path.points, path.places, path.out.length"]
        : ["const walked = level.walk(hero, step);", "hero = walked.place;"];
    const place = start.join(", ");
    return {
        cpp: [
            "#include <abut/abut.hpp>\n",
            "auto level = abut::WalkMesh::build(points, triangles);",
            `abut::WalkPoint hero = level->nearest({${place}});`,
            ...cpp,
        ].join("\n"),
        javascript: ["const level = new abut.WalkMesh(points, triangles);", `let hero = level.nearest([${place}]);`, ...javascript].join(
            "\n",
        ),
    };
}
