// What the scene's thread and the others give each other, without a lock.
#pragma once

#include "drover/spsc_ring.h"
#include "publish/scene_jobs.h"
#include "runtime/scene_sight.h"
#include "runtime/wake.h"

namespace drover::runtime {

/// The rings are between the publish thread and the scene's.
struct SceneExchange {
  SceneSight sight;
  SpscRing<publish::SceneJob, 256> jobs;       ///< publish → scene; full: refused in words
  SpscRing<publish::SceneReply, 256> replies;  ///< scene → publish
  Wake replies_ready;
};

}  // namespace drover::runtime
