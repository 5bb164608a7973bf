#include "kestrel/io/wire_log.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "kestrel/io/svg_histogram.hpp"

namespace kestrel {
namespace {

std::vector<std::string> row(const std::string& name, std::vector<double> values) {
  std::vector<std::string> words = {name, std::to_string(values.size())};
  std::sort(values.begin(), values.end());
  for (const double share : {0.5, 0.95, 0.99, 1.0}) {
    words.push_back(
        values.empty()
            ? "n/a"
            : fmt::format("{:.2f}",
                          values[std::size_t(std::ceil(share * double(values.size() - 1)))]));
  }
  return words;
}

bool is_news(const WireTime& time, const std::optional<double>& newest_capture_s) {
  return time.capture_s && (!newest_capture_s || *time.capture_s > *newest_capture_s);
}

}  // namespace

WireStatistics wire_statistics(const std::vector<WireTime>& times) {
  WireStatistics statistics;
  std::optional<double> newest_capture_s;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const WireTime& now = times[i];
    if (i > 0) statistics.period_ms.push_back((now.sent_s - times[i - 1].sent_s) * 1e3);
    if (!is_news(now, newest_capture_s)) continue;
    newest_capture_s = now.capture_s;
    statistics.latency_ms.push_back((now.sent_s - *now.capture_s) * 1e3);
  }
  return statistics;
}

WireLog::WireLog(const std::filesystem::path& path) : file_(path) {
  file_.write("sent_s,capture_s,period_ms,age_ms,first");
}

void WireLog::write(const WireTime& time) {
  const double start_s = times_.empty() ? time.sent_s : times_.front().sent_s;
  const std::string capture =
      time.capture_s ? fmt::format("{:.6f}", *time.capture_s - start_s) : "";
  const std::string period =
      times_.empty() ? "" : fmt::format("{:.3f}", (time.sent_s - times_.back().sent_s) * 1e3);
  const std::string age =
      time.capture_s ? fmt::format("{:.3f}", (time.sent_s - *time.capture_s) * 1e3) : "";
  const bool news = is_news(time, newest_capture_s_);
  if (news) newest_capture_s_ = time.capture_s;
  file_.write(
      fmt::format("{:.6f},{},{},{},{}", time.sent_s - start_s, capture, period, age, news ? 1 : 0));
  times_.push_back(time);
}

ReportSection wire_section(const std::vector<WireTime>& times) {
  const WireStatistics s = wire_statistics(times);
  ReportSection section;
  section.title = "When the commands left";
  section.text =
      "Period: from one command on the wire to the next. Latency: from the capture of a frame to "
      "the first command that rests on it. Every command is in wire.csv.";
  section.figures = {svg_histogram({"Period of the commands", "ms", s.period_ms}),
                     svg_histogram({"Latency, capture to wire", "ms", s.latency_ms})};
  section.tables = {{"Milliseconds",
                     {"", "count", "median", "95 %", "99 %", "largest"},
                     {row("period", s.period_ms), row("latency", s.latency_ms)}}};
  return section;
}

}  // namespace kestrel
