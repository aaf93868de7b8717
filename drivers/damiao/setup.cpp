#include "drivers/damiao/setup.h"

#include <cmath>

#include "drivers/damiao/rules.h"

namespace drover::damiao {
namespace {

constexpr Duration kAnswerWithin = std::chrono::milliseconds(30);
constexpr int kAttempts = 5;

struct Named {
  const char* name;
  const char* unit;
  double value;
};

Named range_of(std::uint8_t rid, const Ranges& ranges) {
  if (rid == reg::kPMax) return {"position", "rad", ranges.p_max_rad};
  if (rid == reg::kVMax) return {"velocity", "rad/s", ranges.v_max_radps};
  return {"torque", "Nm", ranges.t_max_Nm};
}

}  // namespace

void Setup::begin() {
  state_ = State::asking;
  at_ = 0;
  asked_ = writes_ = written_ = false;
  attempts_ = 0;
  reason_.clear();
}

void Setup::fail() {
  state_ = State::failed;
}

void Setup::on_tick(Time now, DriverOut& out) {
  if (state_ != State::asking) return;
  if (asked_ && now - asked_at_ < kAnswerWithin) return;
  if (asked_ && attempts_ >= kAttempts) {
    reason_.format("its register %u does not answer: nothing is known of its ranges and time-out",
                   static_cast<unsigned>(read_registers()[at_]));
    return fail();
  }
  ask(now, out);
}

void Setup::ask(Time now, DriverOut& out) {
  ++attempts_;
  asked_ = true;
  asked_at_ = now;
  out.send(writes_ ? encode_write(settings_.joint.id, reg::kTimeout, settings_.timeout_raw())
                   : encode_read(settings_.joint.id, read_registers()[at_]));
}

void Setup::on_reply(const RegisterReply& reply) {
  if (state_ != State::asking || !asked_ || reply.rid != read_registers()[at_] ||
      (reply.verb == Verb::write) != writes_)
    return;
  asked_ = false;
  attempts_ = 0;
  if (writes_) {
    // An answer to a write is no proof: it is read again.
    writes_ = false;
    written_ = true;
    return;
  }
  if (!judge(reply)) return;
  if (++at_ == read_registers().size()) state_ = State::done;
}

/// True: this register is as it has to be.
bool Setup::judge(const RegisterReply& reply) {
  if (reply.rid == reg::kTimeout) {
    if (reply.raw == settings_.timeout_raw()) return true;
    writes_ = !written_;
    if (writes_) return false;
    reason_.format("its time-out is %.1f ms, and does not become the configured %u ms",
                   static_cast<double>(reply.raw) / kTimeoutUnitsPerMs,
                   static_cast<unsigned>(settings_.timeout_ms));
  } else if (reply.rid == reg::kMode) {
    if (reply.raw == kMitMode) return true;
    reason_.format("it is in control mode %u, not in %u (MIT): set register 10",
                   static_cast<unsigned>(reply.raw), static_cast<unsigned>(kMitMode));
  } else {
    const Named range = range_of(reply.rid, settings_.joint.ranges);
    const double is = static_cast<double>(reply.as_float());
    // The configured one goes through a float in the motor.
    if (std::abs(is - range.value) <= 1e-4 * range.value) return true;
    reason_.format("its %s range is %.4g %s, configured is %.4g", range.name, is, range.unit,
                   range.value);
  }
  fail();
  return false;
}

}  // namespace drover::damiao
