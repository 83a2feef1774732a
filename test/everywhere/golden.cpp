// Prints one hash over the bits of answers from the whole library, which is the same on every machine.
//
//   golden                     the hash
//   golden --sections          and that of each area, to find a difference
//   golden --section NAME      that of one area alone
//   golden --targets           the vector units that can be forced here, one a line
//   golden --target NAME ...   the answers of this vector unit
//   golden --expect HASH       compares the hash for each vector unit: 1 if any differs
//   golden --save FILE         writes everything that the library saves into one file
//   golden --load FILE         reads such a file of another machine: 1 if anything differs

#include "blobs.hpp"
#include "sections.hpp"
#include <abut/math/detail/blob.hpp>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <hwy/targets.h>

namespace abut::everywhere {
namespace {

// The vector units that are not tested are off, and so is the one that takes denormals as zero.
#if !HWY_ARCH_X86
static_assert(HWY_ENABLED(HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV) == 0);
static_assert(!HWY_ARCH_ARM_V7 || HWY_ENABLED(HWY_NEON) == 0);
#endif

constexpr int usage = 2;

int fail(const char* what, const std::string& name) {
    std::fprintf(stderr, "golden: %s: %s\n", name.c_str(), what);
    return usage;
}

/// The vector units that can be forced. Without Highway's library there are none: the compiler's flags have chosen it.
std::vector<std::string> targets() {
    std::vector<std::string> result;
#ifndef HWY_COMPILE_ONLY_STATIC
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) result.push_back(hwy::TargetName(target));
#endif
    return result;
}
bool force_target([[maybe_unused]] const std::string& name) {
#ifndef HWY_COMPILE_ONLY_STATIC
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name != hwy::TargetName(target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        hwy::SetSupportedTargetsForTest(0);
        return true;
    }
#endif
    return false;
}

/// Of all sections, or of the one with this name. Prints each on request.
std::uint64_t hash_of(std::string_view only = {}, bool print = false) {
    Hash all;
    for (const Section& section : sections) {
        if (!only.empty() && section.name != only) continue;
        Hash hash;
        section.add(hash);
        if (print) std::printf("%016" PRIx64 " %s\n", hash.value(), std::string(section.name).c_str());
        all.add(hash.value());
    }
    return all.value();
}
int print_hash(bool each) {
    const std::uint64_t hash = hash_of({}, each);
    std::printf("%016" PRIx64 "\n", hash);
    return 0;
}
int print_section(const std::string& name) {
    const auto is_named = [&](const Section& section) { return section.name == name; };
    if (std::none_of(std::begin(sections), std::end(sections), is_named)) return fail("no section", name);
    hash_of(name, true);
    return 0;
}

int compare_with(const std::string& expected) {
    std::vector<std::string> names = targets();
    if (names.empty()) names.push_back("");
    int different = 0;
    for (const std::string& name : names) {
        if (!name.empty()) force_target(name);
        char hash[17];
        std::snprintf(hash, sizeof(hash), "%016" PRIx64, hash_of());
        std::printf("%s %s\n", hash, name.c_str());
        if (expected != hash) different = 1;
    }
    return different;
}

int save_blobs(const std::string& path) {
    detail::BlobWriter file;
    for (const Blob& blob : blobs()) {
        file.number(std::uint64_t{blob.bytes.size()});
        file.array(std::span<const std::byte>(blob.bytes));
    }
    std::FILE* out = std::fopen(path.c_str(), "wb");
    const bool is_written =
        out != nullptr && std::fwrite(file.bytes.data(), 1, file.bytes.size(), out) == file.bytes.size();
    return out != nullptr && std::fclose(out) == 0 && is_written ? 0 : fail("cannot be written", path);
}

int load_blobs(const std::string& path) {
    std::FILE* in = std::fopen(path.c_str(), "rb");
    if (in == nullptr) return fail("cannot be read", path);
    std::vector<std::byte> content(std::size_t{1} << 24);
    content.resize(std::fread(content.data(), 1, content.size(), in));
    std::fclose(in);
    detail::BlobReader file(content);
    int different = 0;
    for (const Blob& own : blobs()) {
        std::uint64_t size = 0;
        std::vector<std::byte> bytes;
        if (!file.number(size) || !file.array(bytes, size)) return fail("ends too early", path);
        if (bytes == own.bytes && own.save_again(bytes) == bytes) continue;
        std::printf("%s differs\n", own.name.c_str());
        different = 1;
    }
    return different;
}

int run(std::span<char*> arguments) {
    if (arguments.size() >= 2 && arguments[0] == std::string("--target")) {
        if (!force_target(arguments[1])) return fail("no vector unit of this machine", arguments[1]);
        arguments = arguments.subspan(2);
    }
    const std::string command = arguments.empty() ? "" : arguments[0];
    if (arguments.empty()) return print_hash(false);
    if (command == "--sections" && arguments.size() == 1) return print_hash(true);
    if (command == "--section" && arguments.size() == 2) return print_section(arguments[1]);
    if (command == "--expect" && arguments.size() == 2) return compare_with(arguments[1]);
    if (command == "--targets" && arguments.size() == 1) {
        for (const std::string& name : targets()) std::printf("%s\n", name.c_str());
        return 0;
    }
    if (command == "--save" && arguments.size() == 2) return save_blobs(arguments[1]);
    if (command == "--load" && arguments.size() == 2) return load_blobs(arguments[1]);
    return fail("see the first lines of test/everywhere/golden.cpp", command);
}

}  // namespace
}  // namespace abut::everywhere

int main(int count, char** arguments) {
    return abut::everywhere::run(std::span(arguments, static_cast<std::size_t>(count)).subspan(1));
}
