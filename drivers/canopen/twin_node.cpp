#include "drivers/canopen/twin_node.h"

#include <algorithm>

#include "drover/bytes.h"

namespace drover::canopen {
namespace {

constexpr std::uint32_t kOff = 0x80000000;
constexpr std::uint32_t kIdBits = 0x7FF;
constexpr std::uint8_t kMostMapped = 4;
constexpr std::uint32_t kNoObject = 0x06020000;
constexpr std::uint32_t kReadOnly = 0x06010002;
constexpr Object kProducer{0x1017, 0};
constexpr Object kConsumer{0x1016, 1};

constexpr std::uint16_t of_pdo(std::uint16_t first, std::uint16_t number) {
  return static_cast<std::uint16_t>(first + number);
}

Object mapped_object(std::uint32_t mapped) {
  return {static_cast<std::uint16_t>(mapped >> 16U), static_cast<std::uint8_t>(mapped >> 8U)};
}

}  // namespace

void TwinNode::boot(std::span<const TwinObject> objects, Time now, TwinFrames& out) {
  state_ = NodeState::pre_operational;
  objects_.clear();
  const auto add = [this](const TwinObject& object) {
    static_cast<void>(objects_.push_back(object));
  };
  for (const TwinObject& each : objects) add(each);
  add({kProducer, u16(0)});
  for (std::uint16_t pdo = 0; pdo < kPdos; ++pdo) {
    for (const std::uint16_t first : {std::uint16_t{0x1400}, std::uint16_t{0x1800}}) {
      add({{of_pdo(first, pdo), 1}, u32(kOff)});
      add({{of_pdo(first, pdo), 2}, u8(255)});
      if (first == 0x1800) add({{of_pdo(first, pdo), 5}, u16(0)});
      for (std::uint8_t sub = 0; sub <= kMostMapped; ++sub)
        add({{of_pdo(static_cast<std::uint16_t>(first + 0x200), pdo), sub},
             sub == 0 ? u8(0) : u32(0)});
    }
  }
  next_pdo_.fill(now);
  next_heartbeat_ = now;
  master_heard_ = kNever;
  static_cast<void>(out.push_back(encode_heartbeat(node_, NodeState::boot_up)));
}

const TwinObject* TwinNode::find(Object object) const {
  const auto* const it = std::find_if(objects_.begin(), objects_.end(),
                                      [&](const auto& each) { return each.object == object; });
  return it == objects_.end() ? nullptr : it;
}

std::uint32_t TwinNode::value(Object object) const {
  const TwinObject* const found = find(object);
  return found == nullptr ? 0 : found->value.bits;
}

void TwinNode::set(Object object, std::uint32_t bits) {
  for (TwinObject& each : objects_)
    if (each.object == object) each.value.bits = bits;
}

bool TwinNode::on_frame(const CanFrame& frame, Time now, Writes& writes, TwinFrames& out) {
  if (!frame.is_plain()) return true;
  if (frame.id == 0) {
    if (frame.len != 2 || (frame.data[1] != node_ && frame.data[1] != 0)) return true;
    switch (static_cast<NmtCommand>(frame.data[0])) {
      case NmtCommand::operational: state_ = NodeState::operational; break;
      case NmtCommand::stop: state_ = NodeState::stopped; break;
      case NmtCommand::pre_operational: state_ = NodeState::pre_operational; break;
      case NmtCommand::reset_node:
      case NmtCommand::reset_communication: return false;
    }
    return true;
  }
  const std::uint32_t master = value(kConsumer) >> 16U & 0x7FU;
  const auto heartbeat = decode_heartbeat(frame);
  if (heartbeat && master != 0 && heartbeat->node == master) master_heard_ = now;
  if (frame.id == 0x600U + node_ && state_ != NodeState::stopped) on_sdo(frame, writes, out);
  if (state_ != NodeState::operational) return true;
  for (std::uint16_t pdo = 0; pdo < kPdos; ++pdo) {
    const std::uint32_t id = value({of_pdo(0x1400, pdo), 1});
    if ((id & kOff) == 0 && (id & kIdBits) == frame.id) on_pdo(pdo, frame, writes);
  }
  return true;
}

void TwinNode::on_sdo(const CanFrame& frame, Writes& writes, TwinFrames& out) {
  if (frame.len != 8 || frame.data[0] == 0x80) return;
  const Object object{load_le<std::uint16_t>(frame.data, 1), frame.data[3]};
  const auto say = [&](unsigned command, std::uint32_t number) {
    CanFrame answer = encode_sdo_write(node_, object, u32(number));
    answer.id = 0x580U + node_;
    answer.data[0] = static_cast<std::uint8_t>(command);
    static_cast<void>(out.push_back(answer));
  };
  const TwinObject* const found = find(object);
  if (found == nullptr) return say(0x80, kNoObject);
  const unsigned unused = (4U - found->value.size) << 2U;
  if (frame.data[0] == 0x40) return say(0x43U | unused, found->value.bits);
  if (found->read_only) return say(0x80, kReadOnly);
  if (frame.data[0] != (0x23U | unused)) return say(0x80, kAbortLength);
  set(object, load_le<std::uint32_t>(frame.data, 4));
  static_cast<void>(writes.push_back(*found));
  say(0x60, 0);
}

void TwinNode::on_pdo(std::uint16_t number, const CanFrame& frame, Writes& writes) {
  const std::uint16_t mapping = of_pdo(0x1600, number);
  const auto count = std::min<std::uint32_t>(value({mapping, 0}), kMostMapped);
  std::size_t at = 0;
  for (std::uint8_t sub = 1; sub <= count; ++sub) {
    const std::uint32_t mapped = value({mapping, sub});
    const std::size_t size = (mapped & 0xFFU) / 8;
    if (at + size > frame.len) return;
    std::uint32_t bits = 0;
    for (std::size_t i = size; i-- > 0;) bits = bits << 8U | frame.data[at + i];
    at += size;
    set(mapped_object(mapped), bits);
    if (const TwinObject* const found = find(mapped_object(mapped)))
      static_cast<void>(writes.push_back(*found));
  }
}

void TwinNode::send_pdo(std::uint16_t number, TwinFrames& out) const {
  const std::uint16_t mapping = of_pdo(0x1A00, number);
  CanFrame frame = make_frame(value({of_pdo(0x1800, number), 1}) & kIdBits);
  const auto count = std::min<std::uint32_t>(value({mapping, 0}), kMostMapped);
  for (std::uint8_t sub = 1; sub <= count; ++sub) {
    const std::uint32_t mapped = value({mapping, sub});
    const std::uint32_t bits = value(mapped_object(mapped));
    for (unsigned i = 0; i < (mapped & 0xFFU) / 8 && frame.len < 8; ++i)
      frame.data[frame.len++] = static_cast<std::uint8_t>(bits >> 8U * i);
  }
  static_cast<void>(out.push_back(frame));
}

void TwinNode::on_tick(Time now, TwinFrames& out) {
  const auto due = [now](Time& next, Duration period) {
    if (period <= Duration{} || now < next) return false;
    // A plant that was held up catches up without a burst.
    next = now - next >= 2 * period ? now + period : next + period;
    return true;
  };
  if (due(next_heartbeat_, std::chrono::milliseconds(value(kProducer))))
    static_cast<void>(out.push_back(encode_heartbeat(node_, state_)));
  if (state_ != NodeState::operational) return;
  for (std::uint16_t pdo = 0; pdo < kPdos; ++pdo) {
    const std::uint16_t communication = of_pdo(0x1800, pdo);
    const std::chrono::milliseconds period(value({communication, 5}));
    if ((value({communication, 1}) & kOff) == 0 && due(next_pdo_[pdo], period)) send_pdo(pdo, out);
  }
}

bool TwinNode::lost_its_master(Time now) {
  const std::chrono::milliseconds patience(value(kConsumer) & 0xFFFFU);
  if (patience.count() == 0 || master_heard_ == kNever || now - master_heard_ <= patience)
    return false;
  master_heard_ = kNever;
  return true;
}

}  // namespace drover::canopen
