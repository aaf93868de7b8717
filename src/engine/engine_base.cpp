// The engine's part for a base that takes a twist: inside it has two edges, outside one command.
#include <algorithm>
#include <cmath>

#include "engine/engine_impl.h"
#include "engine/gate/approach.h"

namespace drover::engine {

void Engine::Impl::take_body(const BodyMotion& body, Time time) {
  const bool sane = std::isfinite(body.twist.vx_mps) && std::isfinite(body.twist.wz_radps);
  if (!takes_twist(base) || !body.known || !sane) return;
  ++edges[0].source.samples;
  if (time < edges[0].last_motion) return;
  told = body.twist;
  if (std::isfinite(body.steering_rad)) steering_rad = body.steering_rad;
  const JointVelocities mps = edges_of(base, body.twist);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    edges[i].motion.velocity_radps = mps[i];
    edges[i].last_motion = time;
  }
}

double Engine::Impl::steered_radpm() const {
  const double wheelbase_m = steered_wheelbase_m(base);
  return wheelbase_m > 0 ? curvature_radpm(wheelbase_m, steering_rad) : kAbsent;
}

void Engine::Impl::fill_base(const Environment& environment, const BaseCommand& command) {
  const AxisSnapshot& device = edges[0];
  BaseSnapshot& s = snapshot.base;
  s.measured = told;
  s.steering_rad = steering_rad;
  s.state = device.state;
  s.fault = device.fault;
  s.commanded = command.twist;
  s.bus_V = device.bus_V;
  s.bus_A = device.bus_A;
  s.health = device.health;
  s.source = {environment.base.reason, device.source.samples, environment.base.bad,
              environment.base.overflows};
  s.last_motion = device.last_motion;
}

/// What was decided for the edges, said to the device that moves both.
void Engine::Impl::command_base(EngineOutput& out) {
  JointVelocities mps;
  mps.resize(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    mps[i] = out.axes[i].velocity_radps;
    if (out.axes[i].request != AxisRequest::rest) out.base.request = out.axes[i].request;
    out.axes[i] = {};
  }
  out.base.twist = twist_of_edges(base, mps);
  // Edges that are caught one by one may make a turn that it does not make.
  if (out.base.request == AxisRequest::hold) {
    out.base.twist.vx_mps = no_more_than(out.base.twist.vx_mps, told.vx_mps);
    out.base.twist.wz_radps = no_more_than(out.base.twist.wz_radps, told.wz_radps);
  }
  sent = out.base.twist;
  // The numbers of the edges are those of others outside.
  out.base.slowing_permitted = out.slowing_permitted[0] || out.slowing_permitted[1];
  out.slowing_permitted[0] = out.slowing_permitted[1] = false;
}

}  // namespace drover::engine
