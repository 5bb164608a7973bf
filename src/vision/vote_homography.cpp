#include "kestrel/vision/vote_homography.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <tuple>

namespace kestrel {
namespace {

void require(bool holds, const char* message) {
  if (!holds) throw std::invalid_argument(message);
}

GrowthOptions growth(const VoteOptions& options) {
  return {options.max_reprojection_px, options.min_inliers, options.first_noise_share,
          options.perspective, options.same_place_px};
}

/// An order of pairs by what they are, not by where they stand in the list.
bool is_before(const AffinePair& a, const AffinePair& b) {
  if (a.ratio != b.ratio) return a.ratio < b.ratio;
  return std::tie(a.in_template.u, a.in_template.v, a.in_image.u, a.in_image.v,
                  a.image_from_template(0, 0), a.image_from_template(0, 1)) <
         std::tie(b.in_template.u, b.in_template.v, b.in_image.u, b.in_image.v,
                  b.image_from_template(0, 0), b.image_from_template(0, 1));
}

/// The most distinctive of the pairs that can vote.
std::vector<std::size_t> voters(const std::vector<AffinePair>& pairs, const AffineVotes& votes,
                                std::size_t most) {
  std::vector<std::size_t> chosen;
  chosen.reserve(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (votes.is_usable(i)) chosen.push_back(i);
  }
  if (chosen.size() > most) {
    const auto better = [&](std::size_t a, std::size_t b) { return is_before(pairs[a], pairs[b]); };
    std::nth_element(chosen.begin(), chosen.begin() + std::ptrdiff_t(most), chosen.end(), better);
    chosen.resize(most);
  }
  return chosen;
}

struct Counted {
  int votes;
  std::size_t voter;
};

/// The voters whose predictions are worth trying, most votes first.
std::vector<Counted> candidates(const std::vector<AffinePair>& pairs, const AffineVotes& votes,
                                const VoteOptions& options) {
  std::vector<Counted> counted;
  int most = 0;
  for (const std::size_t i : voters(pairs, votes, std::size_t(options.max_voters))) {
    counted.push_back({votes.count(i), i});
    most = std::max(most, counted.back().votes);
  }
  const double least = std::max(double(options.min_votes), options.min_vote_share * most);
  const auto has_few = [least](const Counted& c) { return c.votes < least; };
  counted.erase(std::remove_if(counted.begin(), counted.end(), has_few), counted.end());
  std::sort(counted.begin(), counted.end(), [&](const Counted& a, const Counted& b) {
    return a.votes != b.votes ? a.votes > b.votes : is_before(pairs[a.voter], pairs[b.voter]);
  });
  return counted;
}

std::vector<PixelPair> places_of(const std::vector<AffinePair>& pairs,
                                 const std::vector<int>& chosen) {
  std::vector<PixelPair> places;
  places.reserve(chosen.size());
  for (const int i : chosen) {
    places.push_back({pairs[std::size_t(i)].in_template, pairs[std::size_t(i)].in_image});
  }
  return places;
}

/// What the candidates grow into, best support first.
std::vector<GrownHomography> answers(const std::vector<Counted>& tried, HomographyGrowth fit,
                                     int max_tries) {
  std::vector<GrownHomography> found;
  int tries = 0;
  for (const Counted& candidate : tried) {
    if (!fit.is_open(candidate.voter)) continue;
    if (++tries > max_tries) break;
    auto grown = fit.grown(candidate.voter);
    if (!grown) continue;
    // An answer that explains less than half of its votes may be a compromise of two others: those
    // must still find their pairs.
    if (2 * int(grown->inliers.size()) >= grown->votes) fit.close(grown->image_from_scaled);
    found.push_back(*std::move(grown));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.support > b.support; });
  return found;
}

/// Mean distance of the template's corners, px.
double corner_distance(const CentredHomography& a, const CentredHomography& b) {
  double sum = 0;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    const Seen p = seen(a, {x, y});
    const Seen q = seen(b, {x, y});
    sum += distance({p.u, p.v}, {q.u, q.v}) / 4;
  }
  return sum;
}

/// Answers with enough pairs that no better answer has, and far enough from each of those.
std::vector<GrownHomography> distinct(std::vector<GrownHomography> all, std::size_t pairs,
                                      const VoteOptions& options) {
  std::vector<char> is_taken(pairs, 0);
  std::vector<GrownHomography> kept;
  for (GrownHomography& answer : all) {
    const auto own = std::count_if(answer.inliers.begin(), answer.inliers.end(),
                                   [&](int i) { return is_taken[std::size_t(i)] == 0; });
    const bool is_far = std::none_of(kept.begin(), kept.end(), [&](const GrownHomography& better) {
      return corner_distance(answer.image_from_scaled, better.image_from_scaled) <
             options.distinct_px;
    });
    if (own < options.min_inliers || !is_far) continue;
    for (const int i : answer.inliers) is_taken[std::size_t(i)] = 1;
    kept.push_back(std::move(answer));
    if (int(kept.size()) == options.max_hypotheses) break;
  }
  return kept;
}

}  // namespace

void VoteOptions::check() const {
  growth(*this).check();
  agreement.check();
  require(max_hypotheses >= 1, "vote.max_hypotheses: must be at least 1");
  require(max_tries >= 1, "vote.max_tries: must be at least 1");
  require(max_voters >= 1, "vote.max_voters: must be at least 1");
  require(min_votes >= 2, "vote.min_votes: must be at least 2");
  require(min_vote_share >= 0 && min_vote_share <= 1, "vote.min_vote_share: must be 0 to 1");
  require(distinct_px > 0 && std::isfinite(distinct_px), "vote.distinct_px: must be above 0");
  require(least_noise_px > 0 && std::isfinite(least_noise_px),
          "vote.least_noise_px: must be above 0");
}

std::vector<FittedHomography> vote_homographies(const std::vector<AffinePair>& pairs,
                                                double width_px, double height_px,
                                                const VoteOptions& options) {
  std::vector<FittedHomography> found;
  if (!(width_px > 1 && height_px > 1)) return found;
  const AffineVotes votes(pairs, options.agreement);
  const HomographyGrowth fit(pairs, votes, width_px, height_px, growth(options));
  auto all = answers(candidates(pairs, votes, options), fit, options.max_tries);
  for (GrownHomography& answer : distinct(std::move(all), pairs.size(), options)) {
    const auto H = uncentred(answer.image_from_scaled, width_px, height_px);
    if (!H) continue;
    const auto covariance = corner_covariance(*H, places_of(pairs, answer.inliers), width_px,
                                              height_px, options.least_noise_px);
    found.push_back({*H, std::move(answer.inliers), covariance, answer.support});
  }
  return found;
}

}  // namespace kestrel
