#pragma once

// Runs the tool as a program: arguments in; stdout, stderr and an exit code out.

#include "../io/gltf_builder.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace abut::test {

using Json = nlohmann::json;

struct Ran {
    int code = -1;
    std::string out, err;
};

class ToolRuns : public SceneFiles {
protected:
    /// Each argument as one word, whatever is in it.
    Ran run(const std::vector<std::string>& arguments) const { return run_after("", arguments); }

    /// The same run with a limit of address space, in MB.
    Ran run_within(int megabytes, const std::vector<std::string>& arguments) const {
        return run_after("ulimit -v " + std::to_string(megabytes * 1024) + "; ", arguments);
    }

private:
    /// `before` is a shell command.
    Ran run_after(const std::string& before, const std::vector<std::string>& arguments) const {
        std::string command = before + quoted(ABUT_TOOL_FILE);
        for (const std::string& argument : arguments) command += " " + quoted(argument);
        const std::filesystem::path out = folder() / "stdout";
        const std::filesystem::path err = folder() / "stderr";
        command += " >" + quoted(out.string()) + " 2>" + quoted(err.string());
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
    }

protected:
    /// Bad input and bad usage have one form: nothing on stdout, one line on stderr, exit code 2.
    std::string refusal(const std::vector<std::string>& arguments) const {
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.code, 2);
        EXPECT_EQ(ran.out, "");
        EXPECT_TRUE(ran.err.starts_with("abut: ")) << ran.err;
        EXPECT_TRUE(ran.err.ends_with("\n"));
        EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
        return ran.err.substr(0, ran.err.size() - (ran.err.empty() ? 0 : 1));
    }
    /// Runs a verb on a file that it must refuse, with more arguments.
    std::string refusal(const std::string& verb, const std::string& file, const std::vector<std::string>& more) const {
        std::vector<std::string> all{verb, file};
        all.insert(all.end(), more.begin(), more.end());
        return refusal(all);
    }

    /// The message of a refusal after the file's name.
    std::string refusal_of(const std::string& name, std::string_view content) const {
        const std::string file = write(name, content).string();
        const std::string line = refusal({"check", file});
        const std::string begins = "abut: " + file + ": ";
        EXPECT_TRUE(line.starts_with(begins)) << line;
        return line.substr(std::min(line.size(), begins.size()));
    }

    /// The parsed output of a verb, the first argument, with --json.
    Json json_of(std::vector<std::string> arguments, int code) const {
        arguments.insert(arguments.begin() + 1, "--json");
        const Ran ran = run(arguments);
        EXPECT_EQ(ran.code, code) << ran.err;
        EXPECT_EQ(ran.err, "");
        return Json::parse(ran.out);
    }
    Json checked(std::vector<std::string> arguments, int code) const {
        arguments.insert(arguments.begin(), "check");
        return json_of(std::move(arguments), code);
    }

    /// Expects a verb that writes a file from a mesh to report the problem and write nothing.
    void expect_bad_meshes_refused(const std::string& verb, const std::string& output) const {
        const std::string nan = write("nan.obj", "o a\nv nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
        EXPECT_TRUE(refusal({verb, nan, "-o", output}).starts_with("abut: " + nan + ": "));
        const std::string empty = write("empty.obj", "o nothing\n").string();
        EXPECT_TRUE(refusal({verb, empty, "-o", output}).starts_with("abut: " + empty + ": "));
        EXPECT_FALSE(std::filesystem::exists(output));
    }

    /// A file of the test's own, not yet there.
    std::string out(const std::string& name) const { return (folder() / name).string(); }

    static std::string content(const std::filesystem::path& file) {
        std::ostringstream text;
        text << std::ifstream(file, std::ios::binary).rdbuf();
        return text.str();
    }

private:
    static std::string quoted(const std::string& word) {
        std::string result = "'";
        for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
        return result + "'";
    }
};

}  // namespace abut::test
