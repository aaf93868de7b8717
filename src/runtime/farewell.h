// What droverd says when it ends of joints that nobody holds then.
#pragma once

#include <string>
#include <vector>

#include "engine/config.h"

namespace drover::runtime {

/// One sentence for each group with joints that carry a weight.
inline std::vector<std::string> what_sinks(const engine::EngineConfig& config) {
  std::vector<std::string> sentences;
  for (const engine::GroupConfig& group : config.groups) {
    std::string joints;
    for (const engine::JointRules& joint : group.joints) {
      if (!joint.carries_weight) continue;
      joints += (joints.empty() ? "" : ", ") + std::string(config.joints[joint.axis].view());
    }
    if (joints.empty()) continue;
    sentences.push_back(std::string(group.name.view()) +
                        ": drover-guard only damps its drives until droverd runs again: what is up "
                        "sinks (" +
                        joints + "), and falls where drover-guard is stopped, too");
  }
  return sentences;
}

}  // namespace drover::runtime
