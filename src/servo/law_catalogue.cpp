#include "kestrel/servo/law_catalogue.hpp"

#include "laws/sheets.hpp"

namespace kestrel {

const LawSheet& law_sheet(Law law) {
  if (law <= Law::PmjT) return laws::sheet_of_point_law(law);
  if (law <= Law::Rls) return laws::sheet_of_search_law(law);
  return laws::sheet_of_feature_law(law);
}

}  // namespace kestrel
