// Why a message was not taken, and where in it the reason stands.
#pragma once

#include <string>

namespace drover::scene {

/// A refused message changes nothing.
struct Refusal {
  std::string path;  ///< like `primitives[2].dimensions[0]`; empty: the message as a whole
  std::string why;   ///< what is wrong and what is allowed
};

}  // namespace drover::scene
