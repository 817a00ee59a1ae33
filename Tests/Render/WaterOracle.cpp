#include "WaterOracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/glm.hpp>

namespace Lantern
{

namespace
{
double Phase(double Cosine, double G) { return (1.0 - G * G) / (4.0 * std::numbers::pi * std::pow(1.0 + G * G - 2.0 * G * Cosine, 1.5)); }

/// Reflectance of the surface from below, where light is reflected wholly at flat angles.
double ReflectanceFromBelow(double Index, double Cosine)
{
	const double Sine = Index * std::sqrt(1.0 - Cosine * Cosine);
	return Sine >= 1.0 ? 1.0 : WaterReflectance(Index, std::sqrt(1.0 - Sine * Sine));
}

class FWalk
{
public:
	FWalk(const FWaterLayer& InLayer, double SunCosine)
	    : Layer(InLayer),
	      SunBelow(BendCosine(InLayer.Index, SunCosine)),
	      Light(0.0, std::sqrt(1.0 - SunCosine * SunCosine), SunCosine)
	{
		SunStrength = (1.0 - WaterReflectance(Layer.Index, SunCosine)) / (Layer.Index * Layer.Index * SunBelow);
	}
	/// Follows one path from the viewer. z counts downwards.
	void Follow(double Cosine, FWaterLight& Sum)
	{
		glm::dvec3 Direction(std::sqrt(1.0 - Cosine * Cosine), 0.0, Cosine);
		double Depth = 0.0, Left = 1.0;
		for (bool bScattered = false;;)
		{
			Depth -= Direction.z * std::log(1.0 - Next());
			if (Depth > Layer.Depth) { return; }
			if (Depth < 0.0)
			{
				if (Next() >= ReflectanceFromBelow(Layer.Index, -Direction.z))
				{
					Sum.OfSky += bScattered ? Left : 0.0;
					return;
				}
				Depth = 0.0; // what is left of its way has the same distribution
				Direction.z = -Direction.z;
				continue;
			}
			bScattered = true;
			Left *= Layer.Albedo;
			Sum.OfSun += Left * SunStrength * Phase(-glm::dot(Light, Direction), Layer.Anisotropy) * std::exp(-Depth / SunBelow);
			Turn(Direction);
			if (Left < 0.02 && Next() < 0.5) { return; }
			Left *= Left < 0.02 ? 2.0 : 1.0;
		}
	}

private:
	double Next() { return Uniform(Engine); }
	void Turn(glm::dvec3& Direction)
	{
		const double G = Layer.Anisotropy, U = Next(), Root = (1.0 - G * G) / (1.0 - G + 2.0 * G * U);
		const double Cosine = std::abs(G) < 1.0e-3 ? 2.0 * U - 1.0 : (1.0 + G * G - Root * Root) / (2.0 * G);
		const double Angle = 2.0 * std::numbers::pi * Next(), Sine = std::sqrt(std::max(1.0 - Cosine * Cosine, 0.0));
		const glm::dvec3 Aside = std::abs(Direction.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
		const glm::dvec3 X = glm::normalize(glm::cross(Direction, Aside)), Y = glm::cross(X, Direction);
		Direction = glm::normalize(Cosine * Direction + Sine * (std::cos(Angle) * X + std::sin(Angle) * Y));
	}

	FWaterLayer Layer;
	double SunBelow, SunStrength = 0.0;
	glm::dvec3 Light; ///< in which the sun's light travels; straight on, as paths look for it
	std::mt19937_64 Engine{1};
	std::uniform_real_distribution<double> Uniform{0.0, 1.0};
};
} // namespace

double WaterReflectance(double Index, double Cosine)
{
	const double F0 = std::pow((Index - 1.0) / (Index + 1.0), 2.0);
	return F0 + (1.0 - F0) * std::pow(1.0 - Cosine, 5.0);
}

double BendCosine(double Index, double Cosine) { return std::sqrt(1.0 - (1.0 - Cosine * Cosine) / (Index * Index)); }

FWaterLight SimulateWater(const FWaterLayer& Layer, double ViewCosine, double SunCosine, uint32_t Paths)
{
	FWalk Walk(Layer, SunCosine);
	FWaterLight Sum;
	for (uint32_t Path = 0; Path < Paths; ++Path) { Walk.Follow(BendCosine(Layer.Index, ViewCosine), Sum); }
	const double Share = (1.0 - WaterReflectance(Layer.Index, ViewCosine)) / double(Paths);
	return {Sum.OfSun * Share, Sum.OfSky * Share};
}

} // namespace Lantern
