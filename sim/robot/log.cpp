#include "sim/robot/log.h"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace drover::sim {
namespace {

constexpr std::size_t kBuffered = 65536;

void append_hex(std::string& text, std::uint32_t value, int digits) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4)
    text += kDigits[(value >> shift) & 15U];
}

}  // namespace

TextLog::TextLog(const std::string& path) {
  if (path.empty()) return;
  fd_ = link::UniqueFd(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!fd_) throw std::runtime_error(path + ": cannot write: " + std::strerror(errno));
  buffer_.reserve(kBuffered + 4096);
}

void TextLog::append(std::string_view text) {
  if (!fd_) return;
  buffer_ += text;
  if (buffer_.size() >= kBuffered) flush();
}

void TextLog::flush() {
  std::size_t done = 0;
  while (fd_ && done < buffer_.size()) {
    const auto n = ::write(fd_.get(), buffer_.data() + done, buffer_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void append_stamp(std::string& line, Time time) {
  std::array<char, 48> stamp{};
  const auto ns = time.time_since_epoch().count();
  const int n = std::snprintf(stamp.data(), stamp.size(), "(%lld.%09lld) ",
                              static_cast<long long>(ns / 1'000'000'000),
                              static_cast<long long>(ns % 1'000'000'000));
  line.append(stamp.data(), static_cast<std::size_t>(n));
}

void append_candump(std::string& line, Time time, std::string_view bus, const CanFrame& frame) {
  append_stamp(line, time);
  line += bus;
  line += ' ';
  constexpr std::uint32_t kErrorFlag = 0x20000000U;
  if (frame.error)
    append_hex(line, frame.id | kErrorFlag, 8);
  else
    append_hex(line, frame.id, frame.extended ? 8 : 3);
  line += frame.fd ? "##0" : "#";
  if (frame.remote) {
    line += 'R';
    if (frame.len > 0) line += static_cast<char>('0' + frame.len);
  } else {
    for (const auto byte : frame.payload()) append_hex(line, byte, 2);
  }
  line += '\n';
}

void CanLog::write(Time time, std::string_view bus, const CanFrame& frame) {
  if (!log_.on()) return;
  last_ = std::max(last_, time);
  line_.clear();
  append_candump(line_, last_, bus, frame);
  log_.append(line_);
}

void SerialLog::write(Time time, std::string_view port, std::span<const std::uint8_t> bytes) {
  if (!log_.on() || bytes.empty()) return;
  constexpr const char* kDigits = "0123456789ABCDEF";
  line_.clear();
  append_stamp(line_, time);
  line_.append(port);
  line_ += ' ';
  for (const std::uint8_t byte : bytes) {
    line_ += kDigits[byte >> 4U];
    line_ += kDigits[byte & 0xFU];
  }
  line_ += '\n';
  log_.append(line_);
}

TruthLog::TruthLog(const std::string& path, const Robot& robot) : log_(path) {
  const auto arm = robot.arm_joints();
  std::string header = "time_s,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,vx_mps,wz_radps,free_ahead_m";
  for (const auto& drive : robot.scenario().drives)
    for (const auto& joint : drive.joints)
      if (std::find(arm.begin(), arm.end(), joint) == arm.end())
        header += "," + joint + "_radps," + joint + "_Nm";
  header += ",imu_ax_mps2,imu_ay_mps2,imu_az_mps2,imu_wx_radps,imu_wy_radps,imu_wz_radps,supply";
  for (const auto& joint : arm) header += "," + joint + "_rad," + joint + "_radps," + joint + "_Nm";
  log_.append(header + "\n");
}

void TruthLog::write(const Robot::Truth& t) {
  if (!log_.on()) return;
  std::array<char, 256> text{};
  int n = std::snprintf(
      text.data(), text.size(), "%.9f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.6f,%.3f", to_s(t.time),
      t.pose.x_m, t.pose.y_m, t.pose.z_m, t.pose.roll_rad, t.pose.pitch_rad, t.pose.yaw_rad,
      t.velocity.vx_mps, t.velocity.wz_radps, std::min(t.free_ahead_m, 999.0));
  log_.append({text.data(), static_cast<std::size_t>(n)});
  for (const auto& wheel : t.wheels) {
    n = std::snprintf(text.data(), text.size(), ",%.5f,%.4f", wheel.velocity_radps,
                      wheel.torque_Nm);
    log_.append({text.data(), static_cast<std::size_t>(n)});
  }
  const Vector3& a = t.imu.specific_force_mps2;
  const Vector3& w = t.imu.angular_velocity_radps;
  n = std::snprintf(text.data(), text.size(), ",%.4f,%.4f,%.4f,%.6f,%.6f,%.6f,%d", a.x, a.y, a.z,
                    w.x, w.y, w.z, t.supply ? 1 : 0);
  log_.append({text.data(), static_cast<std::size_t>(n)});
  for (const auto& joint : t.arm) {
    n = std::snprintf(text.data(), text.size(), ",%.6f,%.5f,%.4f", joint.position_rad,
                      joint.velocity_radps, joint.torque_Nm);
    log_.append({text.data(), static_cast<std::size_t>(n)});
  }
  log_.append("\n");
}

}  // namespace drover::sim
