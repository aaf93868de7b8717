// Missions of 200 m with a seeded mixture of what ordinarily goes wrong in a field.
#pragma once

#include <cstdint>
#include <string>

#include "bench/field_plan.h"

namespace drover::bench {

struct FieldMission {
  FieldPlan plan;
  int rows = 2;
  double leg_m = 20;
};

/// Pure: equal seeds give equal missions.
FieldMission draw_mission(std::uint64_t seed);

/// What goes wrong, in words: a line of what holds all the way, then one each, in order.
std::string in_words(const FieldMission& mission);

}  // namespace drover::bench
