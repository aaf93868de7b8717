// What of the effort of a held joint a weight needs.
#pragma once

#include <cstdint>

#include "engine/config.h"

namespace drover::engine {

/// Nobody knows that as holding begins: it may have pressed against something as well. So its
/// effort is let go slowly. What its law gives falls with it for as long as something else gave
/// way, also where that comes after it; what stays is a weight, which sinks into its stiffness
/// instead, and gets back what it needs. Once for each time of holding, to an end: it cannot
/// swing. Pure.
class JointWeight final {
 public:
  struct Cycle {
    double from_set_rad = 0;  ///< of the joint, from its set point
    double gives_Nm = 0;      ///< the law there
    double stiffness_Nmprad = 0;
    bool stands = false;  ///< to the bit, since the cycle before
    bool rests = false;   ///< its set point, and the joint nearly
    double dt_s = 0;
  };

  explicit JointWeight(const JointRules& rules) : rules_(rules) {}

  /// Holding begins with this effort.
  void begin(double effort_Nm);
  /// One cycle of it. By how much its set point has to be drawn after what followed the joint;
  /// the effort already has what that takes.
  double look(const Cycle& cycle);
  /// It needs so much, as far as is known.
  double keeps_Nm() const { return keeps_Nm_; }

 private:
  enum class Step : std::uint8_t { rests, eases, looks, known };

  double way() const { return began_Nm_ < 0 ? -1 : 1; }
  void ease(const Cycle& cycle);
  double judge(const Cycle& cycle);
  double draw(double stiffness_Nmprad);
  void know(double needs_Nm);
  void come_back(double dt_s);

  JointRules rules_;
  Step step_ = Step::known;
  double began_Nm_ = 0;
  double keeps_Nm_ = 0;
  double needs_Nm_ = 0;      ///< when that is known
  double for_s_ = 0;         ///< it rests, or is looked at
  double from_set_rad_ = 0;  ///< slowly, as is what follows
  double gives_Nm_ = 0;
  bool sunk_ = false;  ///< when it was looked at before: from its set point, and it gave
  double sunk_rad_ = 0;
  double sunk_Nm_ = 0;
  double stood_Nm_ = 0;   ///< let go while it stood to the bit
  double drawn_rad_ = 0;  ///< in all
};

}  // namespace drover::engine
