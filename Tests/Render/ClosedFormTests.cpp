// Scenes whose light is known in closed form, through the reference path tracer. The figures are textbook ones:
// the flux balance of a closed room (furnace, sphere), Lambert's polygon formula, form factors (Howell's
// catalogue C-11 and C-14), and the energy that single-scattering GGX keeps (Heitz 2014).
//
// Every estimate is eight independent pictures; what they scatter gives the statistical error, which must be below a
// third of the tolerance (0.2 % for the furnace, 0.5 % for the rest).
#include <cmath>

#include "Support/RenderFixture.h"

namespace Lantern
{

namespace
{
constexpr double Tolerance = 0.005;
constexpr double FurnaceTolerance = 0.002;
constexpr double FloorAlbedo = 0.5; // of the built-in light scenes

class FClosedFormTest : public FRenderTest
{
protected:
	/// Irradiance of the floor point that the scene's camera looks at.
	FEstimate EstimateFloorIrradiance(const std::string& Scene, uint32_t Samples)
	{
		if (!Load(Scene)) { return {}; }
		FEstimate Estimate = EstimateMean(MakeView(32, 32), Samples, 1);
		Estimate.Mean *= Pi / FloorAlbedo;
		Estimate.StandardError *= Pi / FloorAlbedo;
		return Estimate;
	}
};

// 1. L = Le / (1 − ρ) everywhere.
TEST_F(FClosedFormTest, Furnace)
{
	const std::pair<double, uint32_t> Cases[] = {{0.5, 16}, {0.7, 24}, {0.9, 40}};
	for (const auto& [Albedo, Samples] : Cases)
	{
		ASSERT_TRUE(Load(fmt::format("furnace:{}", Albedo)));
		const std::string Name = fmt::format("furnace, albedo {}", Albedo);
		ExpectClosedForm(Name.c_str(), EstimateMean(MakeView(32, 32), Samples), 0.5 / (1.0 - Albedo), FurnaceTolerance);
	}
}

// 2. Inside a diffuse sphere: indirect irradiance Φ/S · ρ/(1 − ρ). The direct part is known without noise, so that
// taking it away costs no precision.
TEST_F(FClosedFormTest, SphereAroundPointLight)
{
	constexpr double FluxOverArea = 10000.0 / 96.0;
	const std::pair<double, uint32_t> Cases[] = {{0.05, 2}, {0.1, 2}, {0.2, 2}, {0.3, 3}, {0.5, 4}, {0.7, 5}, {0.9, 8}};
	for (const auto& [Albedo, Samples] : Cases)
	{
		ASSERT_TRUE(Load(fmt::format("sphere:{}", Albedo)));
		const FView View = MakeView(32, 32);
		FEstimate Indirect = EstimateMean(View, Samples);
		Indirect.Mean -= MeanGreen(TraceReference(View, 8, 1));
		Indirect.Mean *= Pi / Albedo;
		Indirect.StandardError *= Pi / Albedo;
		const std::string Name = fmt::format("sphere, indirect, albedo {}", Albedo);
		ExpectClosedForm(Name.c_str(), Indirect, FluxOverArea * Albedo / (1.0 - Albedo), Tolerance);
	}
}

// 3. E = L/2 · Σ Θᵢ (Γᵢ·n), unit square at height 1.
TEST_F(FClosedFormTest, PolygonLight)
{
	const std::pair<double, double> Cases[] = {
	    {0, 0.752275}, {0.5, 0.566645}, {1, 0.265005}, {1.5, 0.104637}, {2, 0.043743}, {3, 0.010575}};
	for (const auto& [X, Expected] : Cases)
	{
		const std::string Name = fmt::format("polygon light, x = {}", X);
		ExpectClosedForm(Name.c_str(), EstimateFloorIrradiance(fmt::format("polygonlight:{}", X), 32), Expected, Tolerance);
	}
}

// 4. The picture is the whole receiver: its mean is the form factor times the albedo.
TEST_F(FClosedFormTest, FormFactors)
{
	const std::pair<const char*, double> Cases[] = {{"formfactors:0", 0.199825}, {"formfactors:1", 0.200044}};
	for (const auto& [Scene, Expected] : Cases)
	{
		ASSERT_TRUE(Load(Scene));
		ExpectClosedForm(Scene, EstimateMean(MakeView(32, 32), 192, 1), Expected * FloorAlbedo, Tolerance);
	}
}

// 5. Disk on its axis: E = πL R²/(R² + h²). Sphere above the horizon: E = πL (R/d)² cos θ.
TEST_F(FClosedFormTest, DiskAndSphereLights)
{
	for (const double Height : {0.5, 1.0, 2.0})
	{
		const std::string Name = fmt::format("disk, height {}", Height);
		ExpectClosedForm(
		    Name.c_str(), EstimateFloorIrradiance(fmt::format("disk:{}", Height), 32), Pi / (1.0 + Height * Height), Tolerance);
	}
	const std::pair<double, double> Cases[] = {{1.0, 0.0}, {2.0, 60.0}};
	for (const auto& [Distance, Angle] : Cases)
	{
		const std::string Name = fmt::format("sphere light, distance {}, angle {}", Distance, Angle);
		ExpectClosedForm(Name.c_str(), EstimateFloorIrradiance(fmt::format("spherelight:{}:{}", Distance, Angle), 192),
		    Pi * 0.25 / (Distance * Distance) * std::cos(Angle * Pi / 180.0), Tolerance);
	}
}

/// Gauss–Legendre nodes and weights on [0, 1], by Newton's method on the Legendre polynomial.
std::vector<std::pair<double, double>> MakeGaussLegendre(int Count)
{
	std::vector<std::pair<double, double>> Nodes;
	for (int I = 0; I < Count; ++I)
	{
		double X = std::cos(Pi * (I + 0.75) / (Count + 0.5)), Derivative = 1.0;
		for (int Step = 0; Step < 50; ++Step)
		{
			double P0 = 1.0, P1 = X;
			for (int K = 2; K <= Count; ++K)
			{
				const double P2 = ((2 * K - 1) * X * P1 - (K - 1) * P0) / K;
				P0 = P1;
				P1 = P2;
			}
			Derivative = Count * (X * P1 - P0) / (X * X - 1.0);
			X -= P1 / Derivative;
		}
		Nodes.emplace_back(0.5 * (1.0 + X), 1.0 / ((1.0 - X * X) * Derivative * Derivative));
	}
	return Nodes;
}

/// Looks at the middle of the ggx scene's plane at a cosine, from far enough away that all pixels see the same one.
FView MakeGgxView(double Mu)
{
	const double Sin = std::sqrt(1.0 - Mu * Mu);
	FView View = LookAt(4.0 * glm::dvec3(0, Mu, Sin), {0, 0, 0}, glm::radians(0.05f), 32, 32);
	View.Up = glm::vec3(0, Sin, -Mu);
	return View;
}

// 6. What a GGX metal of F = 1 reflects of a uniform sky, height-correlated Smith masking (ours). At α = 1 the albedo is
// known for each angle; the means over the hemisphere are tabulated for each roughness.
TEST_F(FClosedFormTest, GgxAtAlphaOne)
{
	ASSERT_TRUE(Load("ggx:1"));
	for (const double Mu : {0.05, 0.2, 0.4, 0.6, 0.8, 1.0})
	{
		const std::string Name = fmt::format("ggx, alpha 1, mu {}", Mu);
		ExpectClosedForm(Name.c_str(), EstimateMean(MakeGgxView(Mu), 16, 1), 1.0 - Mu * std::log(1.0 + 1.0 / Mu), Tolerance);
	}
}

TEST_F(FClosedFormTest, GgxHemisphericalMeans)
{
	// Six nodes integrate E(μ) to 1e-4 at α = 1, where both are known, and better below.
	const auto Nodes = MakeGaussLegendre(6);
	double Check = 0.0;
	for (const auto& [Mu, Weight] : Nodes) { Check += Weight * 2.0 * Mu * (1.0 - Mu * std::log(1.0 + 1.0 / Mu)); }
	ASSERT_NEAR(Check, 0.40914, 1e-4);
	const double Means[] = {0.9997, 0.9953, 0.9756, 0.9405, 0.8823, 0.8029, 0.7074, 0.6042, 0.5024, 0.40914};
	for (int I = 0; I < 10; ++I)
	{
		const double Roughness = 0.1 * (I + 1);
		ASSERT_TRUE(Load(fmt::format("ggx:{}", Roughness)));
		FEstimate Mean;
		double Variance = 0.0;
		for (const auto& [Mu, Weight] : Nodes)
		{
			const FEstimate Node = EstimateMean(MakeGgxView(Mu), 32, 1, 4);
			Mean.Mean += Weight * 2.0 * Mu * Node.Mean;
			Variance += std::pow(Weight * 2.0 * Mu * Node.StandardError, 2);
		}
		Mean.StandardError = std::sqrt(Variance);
		const std::string Name = fmt::format("ggx, mean, roughness {:.1f}", Roughness);
		ExpectClosedForm(Name.c_str(), Mean, Means[I], Tolerance);
	}
}

} // namespace
} // namespace Lantern
