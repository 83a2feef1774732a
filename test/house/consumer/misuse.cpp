// Misuse trips assertions in the library and in the headers, or in neither, as the package defines: an installed
// library once had none, whatever its user chose.
#include <abut/abut.hpp>

#include <cstdio>

namespace {

int trips = 0;

}  // namespace

void abut::assert_failed(const char*, const char*, int) {
    ++trips;
}

int main() {
    abut::World2 world;
    const abut::Id id = world.add(abut::Circle{{0, 0}, 1});
    world.remove(id);
    world.remove(id);
    const int of_library = trips;
    ABUT_ASSERT(trips < 0);
    const int of_headers = trips - of_library;
    std::printf("assertions %d, library %d, headers %d\n", asserts, of_library, of_headers);
    return of_library == asserts && of_headers == asserts ? 0 : 1;
}
