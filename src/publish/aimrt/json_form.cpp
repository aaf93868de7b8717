#include "publish/aimrt/json_form.h"

#include <cmath>

#include "json/json_text.h"
#include "publish/aimrt/sensor.pb.h"

namespace drover::publish::aimrt {

namespace {

using json::JsonText;
namespace pb = ::aimrt::protocols;

void write(JsonText& out, double value) {
  if (std::isfinite(value)) {
    out.number(value);
  } else if (std::isnan(value)) {
    out.text("NaN");
  } else {
    out.text(value > 0 ? "Infinity" : "-Infinity");
  }
}

void write(JsonText& out, const pb::common::Header& header) {
  out.key("header").open('{');
  out.key("time_stamp").text(std::to_string(header.time_stamp()));
  out.key("frame_id").text(header.frame_id());
  out.key("sequence_num").text(std::to_string(header.sequence_num()));
  out.close('}');
}

void member(JsonText& out, const char* name, double value) {
  out.key(name);
  write(out, value);
}

void member(JsonText& out, const char* name, const pb::geometry::Vector3& vector) {
  out.key(name).open('{');
  member(out, "x", vector.x());
  member(out, "y", vector.y());
  member(out, "z", vector.z());
  out.close('}');
}

void member(JsonText& out, const char* name, const pb::geometry::Quaternion& rotation) {
  out.key(name).open('{');
  member(out, "x", rotation.x());
  member(out, "y", rotation.y());
  member(out, "z", rotation.z());
  member(out, "w", rotation.w());
  out.close('}');
}

template <class Values>
void numbers(JsonText& out, const char* name, const Values& values) {
  out.key(name).open('[');
  for (const auto value : values) write(out, value);
  out.close(']');
}

}  // namespace

std::string json_form(const pb::sensor::JointState& message) {
  JsonText out;
  out.open('{');
  write(out, message.header());
  out.key("joints").open('[');
  for (const auto& joint : message.joints()) {
    out.open('{').key("name").text(joint.name());
    member(out, "position", joint.position());
    member(out, "velocity", joint.velocity());
    member(out, "effort", joint.effort());
    out.close('}');
  }
  return out.close(']').close('}').take();
}

std::string json_form(const pb::sensor::ImuState& message) {
  JsonText out;
  out.open('{');
  write(out, message.header());
  member(out, "orientation", message.orientation());
  numbers(out, "orientation_covariance", message.orientation_covariance());
  member(out, "angular_velocity", message.angular_velocity());
  numbers(out, "angular_velocity_covariance", message.angular_velocity_covariance());
  member(out, "linear_acceleration", message.linear_acceleration());
  numbers(out, "linear_acceleration_covariance", message.linear_acceleration_covariance());
  return out.close('}').take();
}

std::string json_form(const pb::sensor::TouchState& message) {
  JsonText out;
  out.open('{');
  write(out, message.header());
  out.key("names").open('[');
  for (const auto& name : message.names()) out.text(name);
  out.close(']').key("states").open('[');
  for (const auto& state : message.states()) {
    out.open('{');
    numbers(out, "pressure", state.pressure());
    out.close('}');
  }
  return out.close(']').close('}').take();
}

}  // namespace drover::publish::aimrt
