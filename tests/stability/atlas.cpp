// stability_atlas -o FOLDER [--quick]: errors of the lobe models, of the diffuse integrals and of a light's
// fluence over all of their range, in float32 on the device against quadrature in double precision; published
// forms beside those in use. Writes atlas.json and, for each density of normals and lobe model, an image of
// all values. atlas.py makes a page of it.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../unit/math/quadrature.h"
#include "../unit/shading/oracle.h"
#include "image/exr.h"
#include "kernel_forms.h"
#include "library_dispatch.h"
#include "math/sg.h"
#include "specular_grid.h"
#include "stages/shading/methods.h"

namespace vsgl::test {
namespace {

using Json = nlohmann::ordered_json;

struct Ndf {
  const char* name;
  std::uint32_t kind;
};
constexpr Ndf ndfs[] = {
    {"GGX", interop::NDF_GGX}, {"Beckmann", interop::NDF_BECKMANN}, {"Phong", interop::NDF_PHONG}};

// A published form, and the lobe model of the same mathematics, if there is one.
struct Published {
  const char *name, *same_as;
  std::uint32_t number;
};
constexpr Published published_lobes[] = {
    {"sg, as published", "sg", published_sg_form},
    {"asg, as published", "", published_asg_form},
    {"asg-asg, as published", "asg-asg", published_asg_asg_form},
    {"ndf-filter, as published", "ndf-filter", published_ndf_filter_form},
    {"normalised SG", "", published_normalised_form}};

// Values that are not finite are null in JSON.
Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json();
}

std::size_t count_not_finite(const std::vector<float>& values) {
  return static_cast<std::size_t>(
      std::count_if(values.begin(), values.end(), [](float x) { return !std::isfinite(x); }));
}

// Of a cell: largest difference to the same form in double precision, over the peak.
double arithmetic_error(const SpecularGrid& grid, std::size_t cell, const std::vector<float>& values,
                        const std::vector<double>& twins) {
  double worst = 0;
  const std::size_t lights = grid.lights_per_cell();
  for (std::size_t i = cell * lights; i < (cell + 1) * lights; ++i) {
    const double error = std::abs(double{values[i]} - twins[i]);
    worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
  }
  return worst / grid.peaks[cell];
}

// What the double-precision form of a lobe model answers to each row.
std::vector<double> twins_of(const SpecularGrid& grid, SpecularForm form) {
  std::vector<double> twins;
  for (const Row& row : grid.rows) {
    Arguments a{row};
    const std::uint32_t ndf = a.take_word();
    const double alpha = a.take();
    const Vec3 view = a.take3(), axis = a.take3();
    twins.push_back(form(specular_receiver(ndf, alpha, {0, 0, 1}, view), axis, a.take()));
  }
  return twins;
}

Json describe_model(const SpecularGrid& grid, const std::string& name, const std::vector<float>& values,
                    const std::vector<double>& twins) {
  Json mean = Json::array(), largest = Json::array(), arithmetic = Json::array();
  for (std::size_t cell = 0; cell < grid.axes.cells(); ++cell) {
    const CellErrors errors = cell_errors(grid, cell, values);
    mean.push_back(errors.finite ? number(errors.mean) : Json());
    largest.push_back(errors.finite ? number(errors.largest) : Json());
    if (!twins.empty()) arithmetic.push_back(number(arithmetic_error(grid, cell, values, twins)));
  }
  const GridErrors all = grid_errors(grid, values);
  Json model = {{"name", name},
                {"not_finite", count_not_finite(values)},
                {"median_relative", number(all.median)},
                {"mean_of_peak", number(all.mean)},
                {"mean", mean},
                {"largest", largest}};
  model["arithmetic"] = twins.empty() ? Json() : arithmetic;
  return model;
}

// All values over their cell's peak: a column a sharpness, a block of columns a view; a row a light, a block
// of rows a roughness.
void write_values(const std::filesystem::path& path, const SpecularGrid& grid, const auto& values) {
  const SpecularAxes& axes = grid.axes;
  const std::size_t lights = grid.lights_per_cell(), width = axes.degrees.size() * axes.sharpnesses.size();
  std::vector<float> pixels(width * axes.alphas.size() * lights);
  for (std::size_t a = 0; a < axes.alphas.size(); ++a)
    for (std::size_t d = 0; d < axes.degrees.size(); ++d)
      for (std::size_t s = 0; s < axes.sharpnesses.size(); ++s)
        for (std::size_t light = 0; light < lights; ++light) {
          const std::size_t cell = axes.cell(a, d, s);
          pixels[(a * lights + light) * width + d * axes.sharpnesses.size() + s] =
              static_cast<float>(static_cast<double>(values[cell * lights + light]) / grid.peaks[cell]);
        }
  ExrLevel level{static_cast<int>(width), static_cast<int>(axes.alphas.size() * lights), {}};
  level.channels["answer.V"] = std::move(pixels);
  ExrPart part;
  part.levels.push_back(std::move(level));
  write_exr(path, {{std::move(part)}, {}});
}

Json specular_atlas(gpu::Device& device, const Ndf& ndf, const SpecularAxes& axes, int nodes,
                    const std::filesystem::path& folder) {
  const SpecularGrid grid = specular_grid(ndf.kind, axes, nodes);
  const std::string prefix = std::string(ndf.name) + "-";
  write_values(folder / (prefix + "quadrature.exr"), grid, grid.exact);
  Json models = Json::array(), published = Json::array();
  std::map<std::string, std::vector<double>> twins;
  for (const SpecularLobe& lobe : specular_lobes()) {
    const std::vector<float> values = call_kernel(device, kernel_specular, grid.rows, 1, lobe.kind);
    twins[lobe.name] = twins_of(grid, specular_form(lobe.name));
    models.push_back(describe_model(grid, lobe.name, values, twins[lobe.name]));
    write_values(folder / (prefix + lobe.name + ".exr"), grid, values);
  }
  for (const Published& form : published_lobes) {
    const std::vector<float> values = call_kernel(device, form.number, grid.rows, 1);
    const bool comparable = ndf.kind == interop::NDF_GGX || form.number != published_ndf_filter_form;
    published.push_back(
        describe_model(grid, form.name, values, comparable ? twins[form.same_as] : std::vector<double>{}));
  }
  return {{"ndf", ndf.name},         {"alphas", axes.alphas},
          {"degrees", axes.degrees}, {"sharpnesses", axes.sharpnesses},
          {"models", models},        {"published", published}};
}

struct DiffuseForm {
  const char* name;
  std::uint32_t number;
  bool published, hemisphere;
};
constexpr DiffuseForm diffuse_forms[] = {
    {"clamped cosine, library", cosine_mean_form, false, false},
    {"clamped cosine, kernels", kernel_cosine, false, false},
    {"mass above the horizon", hemisphere_form, false, true},
    {"clamped cosine of 2024, as published", published_cosine_mean_form, true, false},
    {"clamped cosine of 2022, as published", published_cosine_difference_form, true, false},
    {"Lambert's lobe as an SG", sg_cosine_form, true, false},
    {"cosine pulled out", pulled_out_form, true, false}};

// Errors over the peak, rows of angles (degrees, of the light to the normal), columns of sharpnesses.
Json diffuse_atlas(gpu::Device& device, const std::vector<double>& degrees,
                   const std::vector<double>& sharpnesses) {
  std::vector<Row> rows;
  std::vector<double> cosine, hemisphere;
  for (const double angle : degrees)
    for (const double l : sharpnesses) {
      rows.push_back({static_cast<float>(std::cos(angle * pi / 180)), static_cast<float>(l)});
      const double c = double{rows.back()[0]}, peak = vmf_mean_above(1, double{rows.back()[1]}, 1);
      cosine.push_back(vmf_mean_above(c, double{rows.back()[1]}, 1) / peak);
      hemisphere.push_back(vmf_mean_above(c, double{rows.back()[1]}, 0));
    }
  Json forms = Json::array();
  for (const DiffuseForm& form : diffuse_forms) {
    const std::vector<float> values = call_kernel(device, form.number, rows, 1);
    Json errors = Json::array();
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double peak = form.hemisphere ? 1 : vmf_mean_above(1, double{rows[i][1]}, 1);
      errors.push_back(
          number(std::abs(double{values[i]} / peak - (form.hemisphere ? hemisphere[i] : cosine[i]))));
    }
    forms.push_back({{"name", form.name},
                     {"published", form.published},
                     {"not_finite", count_not_finite(values)},
                     {"error", errors}});
  }
  return {{"degrees", degrees}, {"sharpnesses", sharpnesses}, {"forms", forms}};
}

// Relative errors of the light that a cluster of variance 1 m^2 sends along the edge of its lobe: rows of
// sharpnesses of the emission, columns of distances.
Json light_atlas(gpu::Device& device, const std::vector<double>& distances,
                 const std::vector<double>& sharpnesses) {
  std::vector<Row> rows;
  std::vector<double> exact;
  for (const double l : sharpnesses)
    for (const double d : distances) {
      const double angle = std::min(std::sqrt(2 / std::max(l, 0.5)), 1.0);
      Row row{0, 0, static_cast<float>(-d), 1};
      const Row axis = direction({std::sin(angle), 0, std::cos(angle)});
      row.insert(row.end(), axis.begin(), axis.end());
      row.push_back(static_cast<float>(l));
      rows.push_back(row);
      exact.push_back(
          vsgl_incoming({0, 0, double{row[2]}}, 1, {axis[0], axis[1], axis[2]}, double{row[7]}).fluence);
    }
  const auto errors = [&](const std::vector<float>& values, std::size_t stride, std::size_t value) {
    Json all = Json::array();
    for (std::size_t i = 0; i < exact.size(); ++i)
      all.push_back(number(std::abs(double{values[i * stride + value]} / exact[i] - 1)));
    return all;
  };
  const Json forms = {{{"name", "library"},
                       {"published", false},
                       {"error", errors(call_kernel(device, library_incoming, rows, 1), 1, 0)}},
                      {{"name", "kernels"},
                       {"published", false},
                       {"error", errors(call_kernel(device, kernel_incoming, rows, 5), 5, 4)}},
                      {{"name", "as published"},
                       {"published", true},
                       {"error", errors(call_kernel(device, published_fluence_form, rows, 1), 1, 0)}}};
  return {{"distances", distances}, {"sharpnesses", sharpnesses}, {"forms", forms}};
}

std::vector<double> geometric(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low * std::pow(high / low, double(i) / (count - 1)));
  return values;
}
std::vector<double> steps(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  return values;
}

// From a corner of the range to the other; `quick` for a look in seconds. The kernels take light broader than
// sharpness 1e-3 as if it had that.
Json make_atlas(bool quick, const std::filesystem::path& folder) {
  gpu::Device device = make_test_device();
  const SpecularAxes axes =
      quick ? SpecularAxes{{0.001, 0.1, 1}, {0, 75, 89.9}, {1e-3, 16, 1e4, 1e8}}
            : SpecularAxes{geometric(0.001, 1, 13),
                           {0, 30, 60, 75, 85, 89, 89.9},
                           {1e-3, 0.1, 1, 4, 16, 100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10}};
  Json specular = Json::array();
  for (const Ndf& ndf : ndfs) {
    if (quick && ndf.kind != interop::NDF_GGX) continue;
    specular.push_back(specular_atlas(device, ndf, axes, quick ? 16 : 64, folder));
    std::printf("%s\n", ndf.name);
  }
  return {{"device", device.info().name},
          {"specular", specular},
          {"diffuse",
           diffuse_atlas(device, steps(0, 180, quick ? 7 : 37), geometric(1e-6, 1e10, quick ? 9 : 49))},
          {"light",
           light_atlas(device, geometric(1e-6, 1e6, quick ? 9 : 49), geometric(1e-3, 1e10, quick ? 7 : 40))}};
}

}  // namespace
}  // namespace vsgl::test

int main(int argc, char** argv) {
  CLI::App app("stability_atlas: errors of the lobe models over their range, float32 against quadrature");
  std::filesystem::path folder;
  bool quick = false;
  app.add_option("-o,--output", folder, "folder, which exists, for atlas.json and images")->required();
  app.add_flag("--quick", quick, "a coarse grid, GGX only");
  CLI11_PARSE(app, argc, argv);
  try {
    std::ofstream stream(folder / "atlas.json");
    stream << vsgl::test::make_atlas(quick, folder).dump(1) << "\n";
    if (!stream.flush()) throw std::runtime_error("atlas.json: cannot be written");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "stability_atlas: %s\n", error.what());
    return 1;
  }
  return 0;
}
