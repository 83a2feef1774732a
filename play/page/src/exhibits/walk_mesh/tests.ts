// Steps and paths as tests in C++.

import { cppFloat, cppTest, cppVec } from "../../shapes/source_text";
import type { Surface } from "../../shapes/surfaces";
import type { Path, Place, Walked } from "./walker";

const place = ({ triangle, weights }: { triangle: number; weights: ArrayLike<number> }): string =>
    `abut::WalkPoint{${triangle}, ${cppVec(weights)}}`;

function meshOf({ points, triangles }: Surface): string[] {
    const corners = Array.from({ length: triangles.length / 3 }, (_, i) => `{${triangles.slice(3 * i, 3 * i + 3).join(", ")}}`);
    return [
        `const std::vector<abut::Vec3> points{${points.map(cppVec).join(", ")}};`,
        `const std::vector<glm::uvec3> triangles{${corners.join(", ")}};`,
        "const auto mesh = abut::WalkMesh::build(points, triangles);",
        "ASSERT_TRUE(mesh);",
    ];
}

export function stepTest(surface: Surface, from: Place, step: readonly number[], walked: Walked): string {
    const met = ["nothing", "border", "corner", "limit"][walked.met] ?? "nothing";
    return cppTest("Step", [
        ...meshOf(surface),
        `const abut::Walked walked = mesh->walk(${place(from)}, abut::Vec3${cppVec(step)});`,
        `EXPECT_EQ(walked.place, (${place(walked.place)}));`,
        `EXPECT_EQ(walked.length, ${cppFloat(walked.length)});`,
        `EXPECT_EQ(walked.met, abut::WalkMet::${met});`,
        `EXPECT_EQ(walked.turn.mirrored(), ${walked.mirrored});`,
    ]);
}

export function pathTest(surface: Surface, from: Place, to: Place, { out, places }: Path): string {
    const question = `const auto path = mesh->find_path(${place(from)}, ${place(to)});`;
    if (!out) return cppTest("Path", [...meshOf(surface), question, "EXPECT_FALSE(path);"]);
    return cppTest("Path", [
        ...meshOf(surface),
        question,
        "ASSERT_TRUE(path);",
        `EXPECT_DOUBLE_EQ(path->length, ${out.length});`,
        `EXPECT_EQ(path->places.size(), ${places.length}u);`,
    ]);
}
