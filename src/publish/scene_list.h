// What is around the robot as a person is told it: the reply to scene_list.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "publish/scene_jobs.h"
#include "publish/scene_saver.h"

namespace drover::publish {

/// `saver` knows when each came; `robot`: where base_link is in `map`; `problem`: what of the scene
/// is lost.
std::string scene_list_line(const SceneListed& listed, const SceneSaver& saver,
                            const std::optional<scene::Point2>& robot, std::string_view problem);

}  // namespace drover::publish
