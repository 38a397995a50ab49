// A comparison as data: JSON and CSV for programs, LaTeX for papers.
#pragma once

#include <string>

#include "pipeline/compare/comparison.h"

namespace edgewise::compare {

/// {scene, reference, command, version, machine, rows}; numbers read back exactly.
std::string comparisonJson(const Comparison& comparison);
/// One line a row, the JSON's numbers.
std::string comparisonCsv(const Comparison& comparison);
/// A tabular of method, seconds, RMSE, edge RMSE, PSNR, SSIM, FLIP, memory.
std::string comparisonLatex(const Comparison& comparison);

/// A row with its single runs, and back: what --resume keeps. Throws FailureError for what is no row.
std::string rowToText(const Row& row);
Row rowFromText(const std::string& text);

}  // namespace edgewise::compare
