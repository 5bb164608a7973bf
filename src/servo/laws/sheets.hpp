#pragma once

#include "kestrel/servo/law_catalogue.hpp"

/// The catalogue in three parts; each throws std::out_of_range for a law of another part.
namespace kestrel::laws {

const LawSheet& sheet_of_point_law(Law law);    // one or two interaction matrices of points
const LawSheet& sheet_of_search_law(Law law);   // descent and learning
const LawSheet& sheet_of_feature_law(Law law);  // other features: polar ... decoupled

}  // namespace kestrel::laws
