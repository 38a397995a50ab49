// A comparison as data: JSON and CSV for programs, LaTeX for papers.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/compare/comparison.h"

namespace edgewise::compare {

/// {scene, reference, command, version, machine, rows}; numbers read back exactly.
std::string comparisonJson(const Comparison& comparison);
/// One line a row, the JSON's numbers.
std::string comparisonCsv(const Comparison& comparison);
/// A tabular of method, seconds, RMSE, edge RMSE, PSNR, SSIM, FLIP, memory.
std::string comparisonLatex(const Comparison& comparison);

/// What they are made of.
nlohmann::ordered_json machineJson(const Machine& machine);
nlohmann::ordered_json rowJson(const Row& row);
/// Names and values, joined by commas; csvText() is one field.
std::string csvColumns();
std::string csvFields(const Row& row);
std::string csvText(const std::string& text);
/// Names and values, joined by &.
std::string latexColumns();
std::string latexFields(const Row& row);
std::string latexText(const std::string& text);

/// A row with its single runs, and back: what --resume keeps. Throws FailureError for what is no row.
std::string rowToText(const Row& row);
Row rowFromText(const std::string& text);

}  // namespace edgewise::compare
