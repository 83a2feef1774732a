// A game's own job system updates a World: an adapter of two functions. Here std::async stands for the job system.

#include <abut/abut.hpp>

#include <cstdio>
#include <future>
#include <vector>

namespace {

class JobSystem final : public abut::Executor {
public:
    std::uint32_t workers() const override { return 2; }
    void run(std::uint32_t count, abut::FunctionRef<void(std::uint32_t)> part) override {
        std::vector<std::future<void>> jobs;
        for (std::uint32_t worker = 1; worker < workers(); ++worker)
            jobs.push_back(std::async(std::launch::async, [&, worker] {
                for (std::uint32_t i = worker; i < count; i += workers()) part(i);
            }));
        for (std::uint32_t i = 0; i < count; i += workers()) part(i);
        for (std::future<void>& job : jobs) job.wait();
    }
};

}  // namespace

int main() {
    abut::World3 world;
    for (int i = 0; i < 1000; ++i) {
        const auto x = static_cast<float>(i % 10), y = static_cast<float>(i / 10 % 10), z = static_cast<float>(i / 100);
        world.add(abut::Sphere{{0, 0, 0}, 0.5f}, {.pose = {{x, y, z}}});
    }
    abut::World3 same = world;
    JobSystem jobs;
    const std::size_t by_jobs = world.update(jobs).began.size(), by_one_thread = same.update().began.size();
    std::printf("%zu pairs touch, as on one thread\n", by_jobs);
    return by_jobs == by_one_thread && by_jobs == 2700 ? 0 : 1;
}
