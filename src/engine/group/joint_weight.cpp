// What of the effort of a held joint a weight needs.
#include "engine/group/joint_weight.h"

#include <algorithm>
#include <cmath>

#include "engine/gate/approach.h"

namespace drover::engine {
namespace {

constexpr double kRests_s = 0.6;
constexpr double kEases_s = 5;       ///< all of its largest effort
constexpr double kSlowly = 0.25;     ///< as soon as it moves
constexpr double kSmooths_s = 0.08;  ///< what it measures, of what shakes it
constexpr double kMoves_rad = 0.0005;
constexpr double kSees_rad = 0.0007;   ///< what is stiff gave way before
constexpr double kSinks_rad = 0.0012;  ///< some bits of its drive's
constexpr double kLooks_s = 0.3;
/// Of its stiffness: as stiff is what gives way, at least. No weight is.
constexpr double kStiff = 0.3;
constexpr double kDrawn_rad = 0.06;
/// Of its largest effort. Its encoder may stand, and tell nothing.
constexpr double kToTheBit = 0.2;

}  // namespace

void JointWeight::begin(double effort_Nm) {
  *this = JointWeight(rules_);
  began_Nm_ = keeps_Nm_ = needs_Nm_ = effort_Nm;
  if (effort_Nm != 0) step_ = Step::rests;
}

/// Sinking is counted from its set point, so that what went the other way, since what pressed
/// against it is gone, comes back first.
void JointWeight::ease(const Cycle& cycle) {
  const double sank_rad = -way() * from_set_rad_;
  // At once: what is measured slowly comes late.
  const double slower = -way() * cycle.from_set_rad > kMoves_rad ? kSlowly : 1;
  const double eased_Nm =
      std::min(slower * rules_.max_effort_Nm / kEases_s * cycle.dt_s, std::abs(keeps_Nm_));
  keeps_Nm_ -= way() * eased_Nm;
  stood_Nm_ = cycle.stands ? stood_Nm_ + eased_Nm : 0;
  if (stood_Nm_ > kToTheBit * rules_.max_effort_Nm) return know(began_Nm_);
  if (keeps_Nm_ == 0) return know(0);
  if (sank_rad < (sunk_ ? sunk_rad_ + kSinks_rad : kSees_rad)) return;
  step_ = Step::looks;
  for_s_ = 0;
}

/// At rest, since the effort is not let go meanwhile.
double JointWeight::judge(const Cycle& cycle) {
  const double sank_rad = -way() * from_set_rad_;
  const double fell_Nm = way() * (sunk_Nm_ - gives_Nm_);
  const double farther_rad = sank_rad - sunk_rad_;
  const bool before = sunk_ && farther_rad > kSinks_rad / 2;
  const bool gives_way = fell_Nm > kStiff * cycle.stiffness_Nmprad * farther_rad;
  step_ = Step::eases;
  sunk_ = sank_rad > kSees_rad / 2;  // or it was only shaken
  sunk_rad_ = sank_rad;
  sunk_Nm_ = gives_Nm_;
  if (!before || !sunk_) return 0;
  if (gives_way && drawn_rad_ < kDrawn_rad) return draw(cycle.stiffness_Nmprad);
  know(way() * std::clamp(way() * gives_Nm_, 0.0, way() * began_Nm_));
  return 0;
}

double JointWeight::draw(double stiffness_Nmprad) {
  const double drawn_rad = from_set_rad_;
  keeps_Nm_ = way() * std::max(way() * (keeps_Nm_ - stiffness_Nmprad * drawn_rad), 0.0);
  drawn_rad_ += std::abs(drawn_rad);
  from_set_rad_ = sunk_rad_ = 0;
  return drawn_rad;
}

void JointWeight::know(double needs_Nm) {
  needs_Nm_ = needs_Nm;
  step_ = Step::known;
}

void JointWeight::come_back(double dt_s) {
  keeps_Nm_ = approach(keeps_Nm_, needs_Nm_, rules_.max_effort_Nm / kEases_s * dt_s);
}

double JointWeight::look(const Cycle& cycle) {
  const double share = std::min(cycle.dt_s / kSmooths_s, 1.0);
  from_set_rad_ += share * (cycle.from_set_rad - from_set_rad_);
  gives_Nm_ += share * (cycle.gives_Nm - gives_Nm_);
  switch (step_) {
    case Step::rests:
      for_s_ = cycle.rests ? for_s_ + cycle.dt_s : 0;
      if (for_s_ > kRests_s) step_ = Step::eases;
      return 0;
    case Step::eases: ease(cycle); return 0;
    case Step::looks: for_s_ += cycle.dt_s; return for_s_ > kLooks_s ? judge(cycle) : 0;
    case Step::known: come_back(cycle.dt_s); return 0;
  }
  return 0;
}

}  // namespace drover::engine
