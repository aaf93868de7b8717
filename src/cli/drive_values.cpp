#include "cli/drive_values.h"

#include <string>
#include <string_view>

namespace drover::cli {
namespace {

double number_of(const json::Node& values, std::string_view key) {
  const auto* node = values.find(key);
  return node == nullptr ? kAbsent : node->number().value_or(kAbsent);
}

Time instant_of(const json::Node& values) {
  const auto* node = values.find("at_ns");
  const auto ns = node == nullptr ? std::nullopt : node->integer();
  return ns ? Time{Duration{*ns}} : kNever;
}

bool is_true(const json::Node& values, std::string_view key) {
  const auto* node = values.find(key);
  return node != nullptr && node->boolean() != nullptr && *node->boolean();
}

void take_receiver(const json::Node& values, GnssSnapshot& gnss) {
  if (const auto* position = values.find("position")) {
    gnss.position_time = instant_of(*position);
    gnss.position.quality = is_true(*position, "fixed") ? FixQuality::rtk_fixed : FixQuality::none;
    gnss.position.latitude_deg = number_of(*position, "latitude_deg");
    gnss.position.longitude_deg = number_of(*position, "longitude_deg");
    gnss.position.altitude_msl_m = number_of(*position, "altitude_m");
    gnss.position.undulation_m = 0;
  }
  if (const auto* heading = values.find("heading")) {
    gnss.heading_time = instant_of(*heading);
    gnss.receiver_heading_deg = number_of(*heading, "deg");
  }
  if (const auto* speed = values.find("speed")) {
    gnss.velocity_time = instant_of(*speed);
    gnss.velocity.speed_mps = number_of(*speed, "mps");
  }
}

void take_gyro(const json::Node& gyro, ImuSnapshot& imu) {
  imu.time = instant_of(gyro);
  imu.sample.angular_velocity_radps.z = number_of(gyro, "z_radps");
  imu.sample.saturated = is_true(gyro, "saturated");
  imu.roll_rad = number_of(gyro, "roll_rad");
  imu.pitch_rad = number_of(gyro, "pitch_rad");
}

}  // namespace

Snapshot snapshot_of(const json::Node& values) {
  Snapshot made;
  made.time = instant_of(values);
  const auto* axes = values.find("axes");
  if (axes != nullptr && axes->list() != nullptr) {
    for (const json::Node& told : *axes->list()) {
      AxisSnapshot axis;
      axis.last_motion = instant_of(told);
      axis.motion.velocity_radps = number_of(told, "radps");
      axis.commanded_velocity_radps = number_of(told, "asked_radps");
      if (!made.axes.push_back(axis)) break;
    }
  }
  if (const auto* base = values.find("base")) {
    made.base.configured = true;
    made.base.last_motion = instant_of(*base);
    made.base.measured = {number_of(*base, "vx_mps"), number_of(*base, "wz_radps")};
    made.base.commanded = {number_of(*base, "asked_vx_mps"), number_of(*base, "asked_wz_radps")};
  }
  take_receiver(values, made.gnss);
  if (const auto* gyro = values.find("gyro")) take_gyro(*gyro, made.imu);
  made.pose.vx_mps = number_of(values, "vx_mps");
  made.pose.wz_radps = number_of(values, "wz_radps");
  made.pose.x_m = number_of(values, "x_m");
  made.pose.y_m = number_of(values, "y_m");
  made.gnss.pose_heading_deg = number_of(values, "heading_deg");
  const auto* why = values.find("why");
  if (why != nullptr && why->text() != nullptr && !why->text()->empty())
    (void)made.why.push_back(Reason(std::string_view(*why->text())));
  return made;
}

}  // namespace drover::cli
