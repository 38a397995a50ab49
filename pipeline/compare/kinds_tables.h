// A comparison by kinds of edges: JSON, CSV, the page's table and the console's.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/compare/comparison.h"

namespace edgewise::compare {

/// Null for none.
nlohmann::ordered_json kindsJson(const std::optional<judge::KindErrors>& kinds);
nlohmann::ordered_json referenceErrorJson(const std::optional<ReferenceError>& error);

/// Names and values, joined by commas: RMSE and PSNR over all edges, over each kind, and elsewhere.
std::string kindsCsvColumns();
std::string kindsCsvFields(const std::optional<judge::KindErrors>& kinds);

/// Whether any row has kinds.
bool tellsKinds(const Comparison& comparison);
/// A card: a table of dB that sorts, a row a method, and the reference's own error; nothing without kinds.
std::string kindsTable(const Comparison& comparison);
/// The same in columns of text.
std::string kindsText(const Comparison& comparison);

}  // namespace edgewise::compare
