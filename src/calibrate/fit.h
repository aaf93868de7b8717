// Gauss-Newton over the whole drive, with the noise that the drive itself shows.
#pragma once

#include "calibrate/chain.h"

namespace drover::calibrate {

struct Fit {
  bool ok = false;
  SharedValues value{};
  /// Of the shared numbers: the worse of what the model and what the residuals say, piece by piece.
  Matrix<kShared, kShared> covariance{};
  NoiseScales scales{};
  std::size_t outliers = 0;  ///< places and headings
};

Fit fit(Chain& chain);

}  // namespace drover::calibrate
