#pragma once

#include <opencv2/core/mat.hpp>

#include "kestrel/geometry/camera.hpp"

namespace kestrel {

/// The picture as a pinhole at the same place would have taken it, same size: for people to look
/// at (the loop undistorts points, not pictures). The pinhole's focal length is the camera's, made
/// shorter until the middles of the borders are inside, at most 70 degrees off axis. What the
/// camera did not see is black. Throws std::invalid_argument for a picture of another size than the
/// camera's.
cv::Mat undistorted(const cv::Mat& picture, const Camera& camera);

}  // namespace kestrel
