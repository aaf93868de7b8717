// The document's words for nav.status and nav.locate.
#pragma once

#include <string_view>

#include "drover/snapshot.h"

namespace drover::publish {

constexpr std::string_view spelling(LocateState state) {
  switch (state) {
    case LocateState::good: return "LOCATE_TRUE";
    case LocateState::lost: return "LOCATE_FALSE";
    case LocateState::uninit: break;
  }
  return "LOCATE_UNINIT";
}

constexpr std::string_view spelling(NavStatus status) {
  switch (status) {
    case NavStatus::run: return "NAV_RUN";
    case NavStatus::success: return "NAV_SUCCESS";
    case NavStatus::error: return "NAV_ERROR";
    case NavStatus::free: break;
  }
  return "NAV_FREE";
}

}  // namespace drover::publish
