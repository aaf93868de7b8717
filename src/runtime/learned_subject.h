// What of a configuration the values that a robot learned of itself are beside.
#pragma once

#include <cstdint>

#include "config/config.h"
#include "publish/learned_outlet.h"

namespace drover::runtime {

/// Fingerprint of base, drives, receivers and inertial sensors with their options and lines: with
/// another one, what was learned is no error of it.
std::uint64_t learned_subject(const config::DroverConfig& config);

publish::LearnedBeside learned_beside(const config::DroverConfig& config);

}  // namespace drover::runtime
