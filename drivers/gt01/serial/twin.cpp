#include "drivers/gt01/serial/twin.h"

#include <algorithm>
#include <cmath>

#include "drivers/thousandths.h"
#include "drover/bytes.h"

namespace drover::gt01::serial {
namespace {

constexpr Duration kUploadEach = std::chrono::milliseconds(20);
constexpr std::size_t kUploadData = 17;
constexpr std::uint8_t kSpoils = 3;  ///< of packets with wrong sums one in so many is right

std::uint16_t status_of(const ChassisFaults& faults) {
  unsigned bits = faults.remote ? 0U : status::kRemoteOffline;
  if (faults.hard_estop) bits |= status::kHardEstop;
  if (faults.soft_estop) bits |= status::kSoftEstop;
  if (faults.bumper) bits |= status::kFrontBumper;
  if (faults.over_current) bits |= status::kFrontLeftError;
  if (faults.docking) bits |= status::kDockingOn;
  return static_cast<std::uint16_t>(bits);
}

}  // namespace

void Gt01SerialTwin::set_power(bool on, Time now) {
  chassis_.set_power(on, now);
  uploads_ = true;
  framer_.reset();
}

bool Gt01SerialTwin::set_fault(std::string_view name, Time) {
  return chassis_.set_fault(name);
}

void Gt01SerialTwin::on_packet(std::span<const std::uint8_t> packet, Time now) {
  if (const auto twist = asked_twist(packet)) return chassis_.on_twist(*twist, now);
  const auto said = packet.subspan(kBeforeData);
  if (packet[4] == id::kEstop) chassis_.on_soft_estop(said[0] == 1);
  if (packet[4] == id::kUploadSwitch) uploads_ = said[0] != 0;
}

void Gt01SerialTwin::on_bytes(std::span<const std::uint8_t> bytes, Time now) {
  if (!chassis_.is_up()) return;
  framer_.push(
      bytes, [&](std::span<const std::uint8_t> packet) { on_packet(packet, now); }, [] {});
}

/// Front and rear wheel of a side turn alike.
Packet Gt01SerialTwin::upload() {
  const auto tenths = static_cast<std::uint16_t>(std::lround(ChassisModel::kVoltage_V * 10));
  const Twist twist = chassis_.twist();
  const std::int16_t left = thousandths(chassis_.left_mps());
  const std::int16_t right = thousandths(chassis_.right_mps());
  std::array<std::uint8_t, kUploadData> data{};
  store_le(data, 0, tenths);
  store_le(data, 2, status_of(chassis_.faults()));
  store_le(data, 5, thousandths(twist.vx_mps));
  store_le(data, 7, thousandths(twist.wz_radps));
  store_le(data, 9, left);
  store_le(data, 11, right);
  store_le(data, 13, left);
  store_le(data, 15, right);
  Packet packet = compose(sequence_++, id::kUpload, data);
  if (chassis_.faults().bad_sums && sequence_ % kSpoils != 0) packet[packet.size() - 4] ^= 0x55U;
  return packet;
}

std::size_t Gt01SerialTwin::on_tick(Time now, std::span<Shaft> shafts, std::span<char> out) {
  chassis_.on_tick(now, shafts);
  if (!is_due(next_upload_, kUploadEach, now) || !chassis_.tells() || !uploads_) return 0;
  const Packet packet = upload();
  if (out.size() < packet.size()) return 0;
  std::copy(packet.begin(), packet.end(), out.begin());
  return packet.size();
}

}  // namespace drover::gt01::serial
