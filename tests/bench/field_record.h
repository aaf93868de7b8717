// A drive of the field as it was measured, to be judged again open loop by more than one estimate.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bench/field_world.h"

namespace drover::bench {

struct FieldRecord {
  struct Tick {
    Time now = kNever;
    Pose truth;
    double since_s = 0;     ///< since the start, below 0 before it
    std::size_t heard = 0;  ///< measurements up to here
    bool moves = false;
  };

  std::vector<Measurement> measurements;
  std::vector<Tick> ticks;
  Judgement judgement;  ///< of the engine that drove
};

/// The engine drives, and all that it was told is kept.
inline FieldRecord record_drive(const engine::EngineConfig& config, const FieldPlan& plan,
                                const Path& path, double limit_s, std::uint64_t seed) {
  FieldRecord record;
  FieldWorld world(config, plan, seed);
  Time heard = kNever;
  world.listen([&](const Measurement& m) {
    heard = m.received;
    if (!std::holds_alternative<AxisStatus>(m.value)) record.measurements.push_back(m);
  });
  record.judgement =
      world.drive(path, limit_s, [&](const Snapshot&, const Pose& truth, double since_s) {
        record.ticks.push_back(
            {heard, truth, since_s, record.measurements.size(), std::abs(truth.vx_mps) > 0.02});
      });
  return record;
}

/// `tell` gets each measurement, `look` each tick after those that were heard by then.
template <class Tell, class Look>
void play(const FieldRecord& record, const Tell& tell, const Look& look) {
  std::size_t next = 0;
  for (const FieldRecord::Tick& tick : record.ticks) {
    for (; next < tick.heard; ++next) tell(record.measurements[next]);
    look(tick);
  }
}

}  // namespace drover::bench
