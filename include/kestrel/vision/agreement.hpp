#pragma once

#include <vector>

namespace kestrel {

/// How one textured block of the template is shown by the image.
struct BlockLikeness {
  bool is_visible = false;  // all of it inside the image
  double zncc = 0;          // zero-mean normalised cross-correlation, -1 to 1; 0 where not visible
};

/// What makes a picture the template's, block by block: what covers or shades a part of the
/// template changes the blocks there and leaves the others as they are, which one correlation of
/// the whole does not survive.
struct AgreementOptions {
  double alike_zncc = 0.7;          // a block above this shows what the template shows
  double min_alike_share = 0.4;     // of the visible blocks, evident_share()
  double min_better_half = 0.7;     // mean correlation of the better half of the visible blocks
  double min_visible_share = 0.25;  // of the textured blocks
  int min_alike = 8;                // blocks of all levels: fewer can be alike by chance

  /// Throws std::invalid_argument that names the first option out of range.
  void check() const;
};

/// How well an image shows the template.
struct Agreement {
  int blocks = 0;  // textured
  int visible = 0;
  int alike = 0;           // visible, above alike_zncc
  double better_half = 0;  // mean correlation of the better half of the visible blocks

  double alike_share() const { return visible > 0 ? double(alike) / visible : 0; }
  double visible_share() const { return blocks > 0 ? double(visible) / blocks : 0; }
};

/// Counts; reorders what it is given.
Agreement agreement(std::vector<BlockLikeness>& likeness, const AgreementOptions& options);

/// An image's agreement with the template at two levels of detail: noise spoils the finer one
/// first, and the coarser one has fewer blocks, which are alike by chance more often.
struct PlaceAgreement {
  Agreement fine;
  Agreement coarse;  // no blocks when the template has no second level

  /// Mean of the levels that have visible blocks, 0 to 1.
  double alike_share() const;
  /// The same without four blocks of each level, which the eight parameters of an alignment can
  /// make alike whatever the image shows: below alike_share(), far below it for a small template. A
  /// coarse level of no more than four blocks says nothing by itself: all are counted together
  /// then.
  double evident_share() const;
  double better_half() const;
  /// How much of the template is shown and how well, 0 to 1: the product of the two.
  double shown() const { return alike_share() * (better_half() > 0 ? better_half() : 0); }
};

/// True when the image shows the template beyond doubt.
bool is_accepted(const PlaceAgreement& agreement, const AgreementOptions& options);

}  // namespace kestrel
