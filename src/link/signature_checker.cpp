#include "kestrel/link/signature_checker.hpp"

#include <algorithm>

namespace kestrel::mavlink {

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::Genuine:
      return "genuine";
    case Verdict::Unsigned:
      return "unsigned";
    case Verdict::Forged:
      return "forged";
    case Verdict::Replayed:
      return "replayed";
    case Verdict::TooOld:
      return "too old";
    case Verdict::FromFuture:
      return "from the future";
    case Verdict::NoRoom:
      return "no room";
  }
  return "";
}

Verdict SignatureChecker::check(const FrameView& frame, double unix_s) {
  if (!frame.is_signed()) return Verdict::Unsigned;
  if (!signature_matches(frame, key_)) return Verdict::Forged;
  const SigningStamp stamp = signing_stamp(frame);
  const std::uint64_t oldest = signing_time(unix_s - kOldestSignature_s);
  if (stamp.time < oldest) return Verdict::TooOld;
  if (stamp.time > signing_time(unix_s + kFarthestAhead_s)) return Verdict::FromFuture;
  const Envelope from = frame.envelope();
  const Verdict verdict =
      accept_in_its_stream({from.system_id, from.component_id, stamp.link_id, stamp.time}, oldest);
  if (verdict == Verdict::Genuine) newest_ = std::max(newest_, stamp.time);
  return verdict;
}

Verdict SignatureChecker::accept_in_its_stream(const Stream& stream, std::uint64_t oldest) {
  const auto end = streams_.begin() + std::ptrdiff_t(count_);
  const auto known =
      std::find_if(streams_.begin(), end, [&](const Stream& each) { return each.is_same(stream); });
  if (known == end) return accept_new(stream, oldest);
  if (stream.last <= known->last) return Verdict::Replayed;
  *known = stream;
  return Verdict::Genuine;
}

Verdict SignatureChecker::accept_new(const Stream& stream, std::uint64_t oldest) {
  if (stream.last <= floor_) return Verdict::Replayed;
  if (count_ < kStreams) {
    streams_[count_++] = stream;
    return Verdict::Genuine;
  }
  const auto oldest_stream =
      std::min_element(streams_.begin(), streams_.end(),
                       [](const Stream& a, const Stream& b) { return a.last < b.last; });
  if (oldest_stream->last >= oldest) return Verdict::NoRoom;
  floor_ = std::max(floor_, oldest_stream->last);
  *oldest_stream = stream;
  return Verdict::Genuine;
}

}  // namespace kestrel::mavlink
