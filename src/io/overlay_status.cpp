#include "overlay_status.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "kestrel/io/overlay.hpp"

namespace kestrel {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr int kMargin = 8;

double text_width(const std::string& text, double scale) {
  return cv::getTextSize(text, kFont, scale, 1, nullptr).width;
}

std::vector<std::string> groups(const std::string& words) {
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find("   ", begin), words.size());
    out.push_back(words.substr(begin, end - begin));
    begin = std::min(words.find_first_not_of(' ', end), words.size());
  }
  return out;
}

std::vector<std::string> wrapped(const std::vector<std::string>& words, double scale, int width) {
  std::vector<std::string> lines;
  for (const std::string& group : words) {
    const std::string longer = lines.empty() ? group : lines.back() + "   " + group;
    if (lines.empty() || text_width(longer, scale) > width - 2 * kMargin)
      lines.push_back(group);
    else
      lines.back() = longer;
  }
  return lines;
}

// Rounded to 1/parts, without the sign of a zero.
double rounded(double value, double parts) { return std::round(value * parts) / parts + 0.; }

std::string upper(std::string text) {
  for (char& c : text) c = c == '_' ? ' ' : char(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string status_line(const Frame& frame, const Track& track,
                        const std::optional<FailsafeCommand>& sent) {
  std::string reason = name(track.miss);
  std::replace(reason.begin(), reason.end(), '_', ' ');
  std::string line = fmt::format("frame {}", frame.index);
  if (!track.found()) line += "   " + upper(name(track.status)) + ": " + reason;
  if (sent) line += "   " + upper(name(sent->state));
  const bool by_pixels = track.stage == TrackStage::Aligned || track.stage == TrackStage::Searched;
  line += by_pixels ? fmt::format("   {:.0f}% alike", 100 * track.agreement.alike_share())
                    : fmt::format("   {}/{} inliers", track.inliers.size(), track.matches);
  if (!sent) return line;
  const VelocityCommand& v = sent->command;
  return line + fmt::format("   v {:+.2f} {:+.2f} {:+.2f} m/s   yaw {:+.1f} deg/s",
                            rounded(v.forward_m_s, 100), rounded(v.right_m_s, 100),
                            rounded(v.down_m_s, 100), rounded(v.yaw_rate_rad_s * 180 / M_PI, 10));
}

StatusText fitted(const std::string& words, const std::string& longest, int width) {
  StatusText status;
  const double least = 0.35;  // the smallest type that can be read
  status.scale = std::max(least, 0.45 * std::max(1., width / 960.));
  const double wide = text_width(longest, status.scale);
  const double fits = status.scale * (width - 2 * kMargin) / std::max(wide, 1.);
  if (fits < status.scale) status.scale = std::max(least, fits);
  status.rows = int(wrapped(groups(longest), status.scale, width).size());
  status.lines = wrapped(groups(words), status.scale, width);
  status.lines.resize(std::min(status.lines.size(), std::size_t(status.rows)));
  return status;
}

std::string longest_status(const std::optional<FailsafeCommand>& sent) {
  const std::string seen = "frame 00000   COASTING: few keypoints";
  if (!sent) return seen + "   000/000 inliers";
  return seen + "   HOVER   000/000 inliers   v +0.00 +0.00 +0.00 m/s   yaw +00.0 deg/s";
}

void draw(const StatusText& status, cv::Mat strip) {
  strip.setTo(cv::Scalar(34, 28, 24));
  int y = 0;
  for (const std::string& line : status.lines) {
    y += status.line_height();
    int x = kMargin;
    for (const std::string& group : groups(line)) {
      const bool stands_out =
          group.rfind("LOST", 0) == 0 || group == "HOLD" || group == "DECAY" || group == "HOVER";
      const cv::Scalar colour = stands_out         ? cv::Scalar(80, 130, 255)
                                : group == "SERVO" ? cv::Scalar(120, 225, 120)
                                                   : cv::Scalar(235, 235, 235);
      cv::putText(strip, group, cv::Point(x, y - 5), kFont, status.scale, colour, 1, cv::LINE_AA);
      x += int(text_width(group + "   ", status.scale));
    }
  }
}

}  // namespace kestrel
