#include "drivers/drives.h"

namespace drover {
namespace {

constexpr Duration kForeignShown = std::chrono::milliseconds(1000);

}  // namespace

bool ToldStatus::is_due(const AxisStatus& current, bool always) {
  const bool changed = !told_once_ || current.state != told_.state ||
                       current.error_code != told_.error_code || current.lapsed != told_.lapsed ||
                       current.powered != told_.powered || !(current.reason == told_.reason);
  if (!changed && !always) return false;
  told_once_ = true;
  told_ = current;
  return true;
}

bool ForeignCommand::is_shown(Time now) const {
  return at_ != kNever && now - at_ <= kForeignShown;
}

Reason ForeignCommand::text() const {
  Reason text;
  text.format("somebody else commands it: id 0x%03X on the bus", static_cast<unsigned>(id_));
  return text;
}

}  // namespace drover
