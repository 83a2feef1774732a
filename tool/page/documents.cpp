#include "tool/page/documents.hpp"

#include "tool/page/page.hpp"
#include "tool/page/scene_picture.hpp"
#include "tool/shared/version.hpp"

namespace abut::tool {
namespace {

Vec3 up_of(const CheckPlan& plan) {
    if (!plan.faults.up || plan.faults.up->axis < 0) return {0, 1, 0};
    Vec3 up{};
    up[plan.faults.up->axis] = plan.faults.up->sign;
    return up;
}

}  // namespace

void add_documents(FileReport& report, const CheckPlan& plan, const Scene& scene, const SceneObjects& objects,
                   const std::vector<double>& times, const LevelView<3>& level) {
    const Vec3 up = up_of(plan);
    if (plan.wants_page) {
        PageScene3 shown(scene, objects, times);
        report.page = page(page_json(report, shown, up, version()));
    }
    if (plan.wants_picture) report.picture = scene_picture(report, level, up);
}

void add_documents(FileReport& report, const CheckPlan& plan, const Level&, const LevelObjects&,
                   const std::vector<double>& times, const LevelView<2>& level) {
    if (plan.wants_page) {
        PageScene2 shown(level, times);
        report.page = page(page_json(report, shown, {0, 1, 0}, version()));
    }
    if (plan.wants_picture) report.picture = scene_picture(report, level);
}

}  // namespace abut::tool
