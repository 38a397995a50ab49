#include "pipeline/compare/comparison_tables.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "pipeline/compare/error_slope.h"
#include "pipeline/compare/kinds_tables.h"
#include "pipeline/error.h"
#include "pipeline/json_text.h"
#include "pipeline/methods/mesh_report.h"

namespace edgewise::compare {
namespace {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

Json spreadJson(const std::vector<double>& values) {
    const Spread s = spreadOf(values);
    if (s.runs == 0) return nullptr;
    return {{"median", s.median}, {"min", s.min}, {"max", s.max}, {"runs", s.runs}};
}

Json filterJson(const Row& row) {
    return {{"name", row.filter}, {"radius", row.radius}, {"sigma", orNull(row.sigma)}};
}

Json planJson(const std::vector<PlanEntry>& plan) {
    Json json = Json::array();
    for (const PlanEntry& entry : plan)
        json.push_back({{"stage", entry.stage}, {"runs", entry.runs}, {"why", entry.why}});
    return json;
}

Json distanceJson(const std::optional<PictureDistance>& distance) {
    if (!distance) return nullptr;
    return {{"rmse", distance->rmse}, {"max", distance->max}, {"edge_rmse", orNull(distance->edge_rmse)}};
}

std::optional<PictureDistance> distanceFromJson(const nlohmann::json& json) {
    if (json.is_null()) return std::nullopt;
    PictureDistance distance{json.at("rmse"), json.at("max"), {}};
    if (!json.at("edge_rmse").is_null()) distance.edge_rmse = json.at("edge_rmse").get<double>();
    return distance;
}

Json meshReferenceJson(const MeshReference& reference) {
    Json levels = Json::array();
    for (const MeshLevel& level : reference.levels)
        levels.push_back({{"error_px", level.error_px},
                          {"mesh", meshJson(level.mesh)},
                          {"moved", distanceJson(level.moved)},
                          {"own_error", distanceJson(level.left)}});
    return {{"stated", reference.stated},
            {"reached", reference.reached()},
            {"levels", levels},
            {"silhouette_px",
             {{"field_to_mesh", reference.silhouette_there_px},
              {"mesh_to_field", reference.silhouette_back_px},
              {"mean", reference.silhouette_mean_px}}}};
}

Json fileJson(const std::string& name) {
    return name.empty() ? Json() : Json(name);
}

}  // namespace

Json machineJson(const Machine& machine) {
    return {{"host", machine.host},
            {"processor", machine.processor},
            {"cores", machine.cores},
            {"memory_mib", machine.memory_mib}};
}

Json rowJson(const Row& row) {
    Json stages = Json::object();
    for (const auto& [name, seconds] : row.stages) stages[name] = spreadOf(seconds).median;
    const Spread setup = spreadOf(row.setup_seconds);
    return {{"method", row.method},
            {"parameters", row.parameters},
            {"filter", filterJson(row)},
            {"size", {row.size.x, row.size.y}},
            {"device", row.device},
            {"status", nameOf(row.status)},
            {"why", row.why.empty() ? Json() : Json(row.why)},
            {"seconds", spreadJson(row.seconds)},
            {"setup_seconds", setup.runs == 0 ? Json() : Json(setup.median)},
            {"stages", stages},
            {"error", row.error ? judge::metricsJson(*row.error) : Json()},
            {"bias_half_width", orNull(row.bias_half_width)},
            {"few_edges",
             row.few_edges ? Json{{"pixels", row.few_edges->pixels}, {"rmse", row.few_edges->rmse}} : Json()},
            {"edge_kinds", kindsJson(row.kinds)},
            {"mesh", meshJson(row.mesh)},
            {"reference_error", distanceJson(row.reference_error)},
            {"antialiasing", distanceJson(row.antialiasing)},
            {"counts", row.counts},
            {"peak_mib", row.peak_mib},
            {"exr", fileJson(row.exr)},
            {"png", fileJson(row.png)},
            {"plan", planJson(row.plan)},
            {"notes", row.notes}};
}

/// As CSV has text: in quotes where it needs them.
std::string csvText(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

namespace {

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : "";
}

}  // namespace

std::string latexText(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

namespace {

/// 1.2e-3 as a power of ten.
std::string latexNumber(double value) {
    if (value == 0.0) return "0";
    const std::string text = fmt::format("{:.1e}", value);
    const std::size_t e = text.find('e');
    return fmt::format("${}\\cdot 10^{{{}}}$", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

}  // namespace

std::string latexColumns() {
    return "method & seconds & RMSE & edge RMSE & PSNR & SSIM & FLIP & MiB";
}

std::string latexFields(const Row& row) {
    const Spread seconds = spreadOf(row.seconds);
    std::string out = latexText(row.method) + " & ";
    out += seconds.runs == 0 ? nameOf(row.status) : fmt::format("{:.4g}", seconds.median);
    if (!row.error) return out + fmt::format(" & & & & & & {:.0f}", row.peak_mib);
    const judge::ErrorMetrics& e = *row.error;
    return out + fmt::format(" & {} & {} & {} & {:.5f} & {:.4f} & {:.0f}", latexNumber(e.rmse),
                             e.edge_rmse ? latexNumber(*e.edge_rmse) : "",
                             e.psnr ? fmt::format("{:.1f}", *e.psnr) : "", e.ssim, e.flip, row.peak_mib);
}

std::string comparisonJson(const Comparison& c) {
    Json json{{"scene", c.scene},     {"reference", c.reference},          {"command", c.command},
              {"version", c.version}, {"machine", machineJson(c.machine)}, {"rows", Json::array()}};
    json["reference_error"] = referenceErrorJson(c.reference_error);
    for (const Row& row : c.rows) json["rows"].push_back(rowJson(row));
    if (c.mesh_reference) json["mesh_reference"] = meshReferenceJson(*c.mesh_reference);
    json["slopes"] = Json::array();
    for (const ErrorSlope& s : errorSlopes(c.rows))
        json["slopes"].push_back({{"family", s.family},
                                  {"slope", s.slope},
                                  {"edge_slope", orNull(s.edge_slope)},
                                  {"few_edges_slope", orNull(s.few_edges_slope)},
                                  {"samples", {s.least, s.most}},
                                  {"rows", s.rows}});
    return jsonText(json, 2) + "\n";
}

std::string csvColumns() {
    return "method,filter,radius,sigma,width,height,device,status,seconds,seconds_min,seconds_max,runs,"
           "setup_seconds,rmse,max,bias,psnr,edge_rmse,edge_psnr,ssim,flip,peak_mib," +
           kindsCsvColumns();
}

std::string csvFields(const Row& row) {
    const Spread s = spreadOf(row.seconds);
    std::string out =
        fmt::format("{},{},{},{},{},{},{},{},", csvText(row.method), csvText(row.filter), row.radius,
                    number(row.sigma), row.size.x, row.size.y, row.device, nameOf(row.status));
    out += s.runs == 0 ? ",,,0,,"
                       : fmt::format("{},{},{},{},{},", s.median, s.min, s.max, s.runs,
                                     spreadOf(row.setup_seconds).median);
    if (row.error)
        out += fmt::format("{},{},{},{},{},{},{},{},", row.error->rmse, row.error->max, row.error->bias,
                           number(row.error->psnr), number(row.error->edge_rmse),
                           number(row.error->edge_psnr), row.error->ssim, row.error->flip);
    else
        out += ",,,,,,,,";
    return out + fmt::format("{},", row.peak_mib) + kindsCsvFields(row.kinds);
}

std::string comparisonCsv(const Comparison& c) {
    std::string out = csvColumns() + "\n";
    for (const Row& row : c.rows) out += csvFields(row) + "\n";
    return out;
}

std::string comparisonLatex(const Comparison& c) {
    std::string out = "\\begin{tabular}{lrrrrrrr}\n\\hline\n" + latexColumns() + " \\\\\n\\hline\n";
    for (const Row& row : c.rows) out += latexFields(row) + " \\\\\n";
    return out + "\\hline\n\\end{tabular}\n";
}

std::string rowToText(const Row& row) {
    Json json = rowJson(row);
    json["seconds"] = row.seconds, json["setup_seconds"] = row.setup_seconds, json["stages"] = row.stages;
    json["signed_map"] = row.signed_map, json["absolute_map"] = row.absolute_map;
    return jsonText(json) + "\n";
}

Row rowFromText(const std::string& text) {
    try {
        const Json json = Json::parse(text);
        const auto optional = [](const Json& value) {
            return value.is_null() ? std::optional<double>() : std::optional<double>(value.get<double>());
        };
        const auto name = [](const Json& value) { return value.is_null() ? "" : value.get<std::string>(); };
        Row row;
        row.method = json.at("method"), row.parameters = json.at("parameters");
        row.filter = json.at("filter").at("name"), row.radius = json.at("filter").at("radius");
        row.sigma = optional(json.at("filter").at("sigma"));
        row.size = {json.at("size")[0], json.at("size")[1]};
        row.device = json.at("device"), row.why = name(json.at("why"));
        for (const RowStatus status : {RowStatus::kOk, RowStatus::kTimeout, RowStatus::kFailed})
            if (nameOf(status) == json.at("status")) row.status = status;
        row.seconds = json.at("seconds").get<std::vector<double>>();
        row.setup_seconds = json.at("setup_seconds").get<std::vector<double>>();
        row.stages = json.at("stages").get<std::map<std::string, std::vector<double>>>();
        row.counts = json.value("counts", row.counts);
        row.mesh = meshFromJson(json.at("mesh"));
        row.reference_error = distanceFromJson(json.at("reference_error"));
        row.antialiasing = distanceFromJson(json.at("antialiasing"));
        row.peak_mib = json.at("peak_mib");
        if (const Json& e = json.at("error"); !e.is_null()) {
            judge::ErrorMetrics& error = row.error.emplace();
            error.rmse = e.at("rmse"), error.max = e.at("max"), error.bias = e.at("bias");
            error.psnr = optional(e.at("psnr"));
            error.edge_rmse = optional(e.at("edge_rmse")), error.edge_psnr = optional(e.at("edge_psnr"));
            error.ssim = e.at("ssim"), error.flip = e.at("flip");
        }
        row.bias_half_width = optional(json.at("bias_half_width"));
        if (const Json& few = json.at("few_edges"); !few.is_null())
            row.few_edges = {few.at("pixels"), few.at("rmse")};
        if (const Json kinds = json.value("edge_kinds", Json()); !kinds.is_null())
            row.kinds = judge::kindErrorsFrom(kinds);
        for (const Json& entry : json.at("plan"))
            row.plan.push_back({entry.at("stage"), entry.at("runs"), entry.at("why")});
        row.notes = json.at("notes").get<std::vector<std::string>>();
        row.exr = name(json.at("exr")), row.png = name(json.at("png"));
        row.signed_map = json.at("signed_map"), row.absolute_map = json.at("absolute_map");
        return row;
    } catch (const nlohmann::json::exception& error) {
        throw FailureError("--resume", error.what());
    }
}

}  // namespace edgewise::compare
