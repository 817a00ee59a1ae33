// What all render tests stand on: one Vulkan device per process behind the driver's validation layers and the RHI's
// own wrapper, a sample engine on it, and pictures of scenes. A message of either validation fails the test in which
// it came. Tests need a driver with ray-tracing pipelines (lavapipe has them).
#pragma once

#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "LanternHost/ReferenceRenderer.h"
#include "LanternHost/SampleEngine.h"
#include "Support/StatusChecks.h"

/// Real scenes lie beside the project, or where LANTERN_SCENES or LANTERN_SHARED says; without them a test is skipped.
#define REQUIRE_SCENE(Variable, Name)                                                                                                      \
	const std::string Variable = ::Lantern::FindScene(Name);                                                                               \
	if (Variable.empty()) { GTEST_SKIP() << Name << " is not there (LANTERN_SCENES may name its folder)"; }

namespace Lantern
{

inline constexpr double Pi = std::numbers::pi;

/// Path of a file of the scenes folder; empty where it is missing.
std::string FindScene(const std::string& Name);

/// A mean with the standard error that independent repetitions show.
struct FEstimate
{
	double Mean = 0.0, StandardError = 0.0;
};
FEstimate MakeEstimate(const std::vector<double>& Values);

/// Within a relative tolerance of a closed form; the estimate's own error must be at most a third of it, so that a pass
/// means something and a failure is no bad luck. Prints the figure.
void ExpectClosedForm(const char* What, const FEstimate& Estimate, double Expected, double Tolerance);
void PrintFigure(const std::string& Text);

/// Enough that what longer paths would bring is below 1e-6 of the whole at any albedo used here.
inline constexpr uint32_t UnlimitedBounces = 1024;

class FRenderTest : public ::testing::Test
{
protected:
	void SetUp() override;
	void TearDown() override;

	static IRTDevice& GetDevice();
	static FSampleEngine& GetEngine();
	static FHostScene& GetScene() { return GetEngine().GetScene(); }

	/// A built-in scene ("sphere:0.7") or a file, with the light that it suggests. False: a failure has been recorded.
	[[nodiscard]] bool Load(const std::string& Name);
	[[nodiscard]] bool Load(FSceneDescription Scene);
	/// Light of comparisons outdoors: sun 4 lux along (0.25, −1, 0.35).
	static void SetSun(double DiameterDegrees, float Irradiance = 4.0f, glm::dvec3 Direction = {0.25, -1.0, 0.35});
	static void SetSky(glm::vec3 Radiance);
	/// A point lamp, or with a radius in metres a sphere of that intensity.
	static FSceneLight MakeLamp(const glm::dvec3& Position, glm::vec3 Intensity, float Radius = 0.0f);
	static void SetVariable(const char* Name, const std::string& Value);

	/// Runs a compute shader and waits for it. Results: the buffer that the shader writes and the host reads.
	static void Dispatch(
	    IRTPipeline* Pipeline, const void* Push, uint32_t PushBytes, uint32_t GroupsX, uint32_t GroupsY, IRTBuffer* Results);

	static FView MakeView(uint32_t Width, uint32_t Height) { return GetScene().MakeDefaultView(Width, Height); }
	/// Linear radiance of one frame.
	FImage RenderLighting(const FView& View, double Time = 0.0);
	/// Renders Factor times finer in each direction and averages: the mean of a pixel, as the reference has it.
	FImage RenderLightingFine(FView View, uint32_t Factor, double Time = 0.0);
	/// Mean of a signal over frames First … First + Count − 1. If a frame does not have it, the test fails and the picture is black.
	static FImage RenderSignal(ESignal Signal, const FView& View, uint32_t Count = 1, uint32_t First = 0, double Time = 0.0);
	FImage RenderSunShadow(const FView& View, uint32_t Count = 1, uint32_t First = 0, double Time = 0.0);
	/// Renders the reference. If that fails, the test fails and the picture is black.
	static FImage TraceReference(const FReferenceSettings& Settings);
	FImage TraceReference(const FView& View, uint32_t Samples, uint32_t Bounces = UnlimitedBounces, double Time = 0.0);
	/// Mean of the green channel over the picture, from Batches pictures of Samples with seeds of their own.
	FEstimate EstimateMean(FView View, uint32_t Samples, uint32_t Bounces = UnlimitedBounces, uint32_t Batches = 8);
};

double MeanGreen(const FImage& Image);
/// Largest |a − b| of all channels.
double MaxDifference(const FImage& A, const FImage& B);
/// Fraction of the pixels in which some channel differs by more than Threshold.
double FractionDiffering(const FImage& A, const FImage& B, double Threshold);
/// Means of Factor × Factor pixels.
FImage Shrink(const FImage& Image, uint32_t Factor);

} // namespace Lantern
