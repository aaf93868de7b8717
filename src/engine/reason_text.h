// A sentence that is put together from parts; what does not fit is cut.
#pragma once

#include <string_view>

#include "drover/fixed_text.h"

namespace drover::engine {

inline void append(Reason& text, std::string_view more) {
  text.format("%.*s%.*s", static_cast<int>(text.view().size()), text.view().data(),
              static_cast<int>(more.size()), more.data());
}

}  // namespace drover::engine
