// Light in a layer of water over a black bed, by a simulation in double precision. Tests of scattering are held against it.
#pragma once

#include <cstdint>

namespace Lantern
{

struct FWaterLayer
{
	double Depth = 1.0;      ///< optical, straight down
	double Albedo = 0.0;     ///< of a single scattering
	double Anisotropy = 0.0; ///< of Henyey and Greenstein
	double Index = 1.333;
};

/// What leaves a layer towards a viewer, but for what its surface reflects.
struct FWaterLight
{
	double OfSun = 0.0; ///< for an irradiance of 1 on the surface, from a sun that is not seen
	double OfSky = 0.0; ///< for a sky of radiance 1
};

/// ViewCosine, SunCosine: against the surface's normal, in the air. The sun stands at a right angle to the plane of the view.
FWaterLight SimulateWater(const FWaterLayer& Layer, double ViewCosine, double SunCosine, uint32_t Paths);

/// Schlick's approximation, of the surface from above.
double WaterReflectance(double Index, double Cosine);

/// Cosine of a direction below the surface that has Cosine above it.
double BendCosine(double Index, double Cosine);

} // namespace Lantern
