// The engine's part for a base that takes a twist: inside it has two edges, outside one command.
#include <cmath>

#include "engine/engine_impl.h"

namespace drover::engine {

void Engine::Impl::take_body(const BodyMotion& body, Time time) {
  const bool sane = std::isfinite(body.twist.vx_mps) && std::isfinite(body.twist.wz_radps);
  if (!takes_twist(base) || !body.known || !sane) return;
  const JointVelocities mps = edges_of(base, body.twist);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (time < edges[i].last_motion) return;
    edges[i].motion.velocity_radps = mps[i];
    edges[i].last_motion = time;
  }
}

/// What was decided for the edges, said to the device that moves both.
void Engine::Impl::command_base(EngineOutput& out) {
  JointVelocities mps{};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    mps[i] = out.axes[i].velocity_radps;
    if (out.axes[i].request != AxisRequest::rest) out.base.request = out.axes[i].request;
    out.axes[i] = {};
  }
  out.base.twist = twist_of_edges(base, mps);
  out.slowing_permitted[0] = out.slowing_permitted[0] || out.slowing_permitted[1];
  out.slowing_permitted[1] = false;
}

}  // namespace drover::engine
