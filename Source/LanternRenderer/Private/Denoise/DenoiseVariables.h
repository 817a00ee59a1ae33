// The console variables of one filtered signal: <Prefix>.Denoise, .HistorySeconds, .FilterPasses and so on.
#pragma once

#include <memory>

#include "LanternCore/Config/ConsoleVariables.h"

namespace Lantern
{

struct FDenoiseSettings
{
	float HistorySeconds = 0.5f; ///< time constant of the accumulation; ≥ 0, 0: none
	/// For colours: history stays within the neighbourhood's mean ± this many standard deviations; 0: not clamped.
	float ClampSigma = 7.0f;
	/// Accumulation starts anew where the neighbourhood's mean differs from that over time by more than this many of its
	/// standard errors; 0: never.
	float ChangeSigma = 2.0f;
	/// Share of the difference between a history's texels that counts as error where it is resampled between them.
	float Resampling = 0.5f;
	uint32_t Passes = 4;       ///< of the wavelet, 0 to 5; together they reach FirstStep * (2^Passes − 1) pixels
	uint32_t FirstStep = 1;    ///< pixels between the taps of the first pass; more where neighbours share their noise
	float SigmaValue = 4.0f;   ///< edge stop on the signal, in standard deviations
	float ReachExtent = 0.25f; ///< standard deviation of the wavelet's reach where extents are known, in extents
	float SigmaNormal = 64.0f; ///< exponent of the cosine between normals
	float SigmaDepth = 1.0f;   ///< edge stop on the distance to the neighbour's plane, in pixel footprints
};

struct FDenoiseDefaults
{
	float SigmaValue = 4.0f;
	uint32_t Passes = 4;
	bool bExtent = false; ///< the signal comes with extents: <Prefix>.FilterReach exists
	bool bColor = false;  ///< the signal is a colour: <Prefix>.ClampSigma exists
	float ClampSigma = FDenoiseSettings().ClampSigma;
	float HistorySeconds = FDenoiseSettings().HistorySeconds;
};

/// Static storage; the variables register themselves. Reads are for the render thread.
class FDenoiseVariables
{
public:
	/// Prefix: "r.RT.AO".
	FDenoiseVariables(const char* Prefix, const FDenoiseDefaults& Defaults);
	~FDenoiseVariables();
	FDenoiseVariables(const FDenoiseVariables&) = delete;
	FDenoiseVariables& operator=(const FDenoiseVariables&) = delete;

	bool IsEnabled() const;
	FDenoiseSettings Get() const;

private:
	struct FVariables;
	std::unique_ptr<FVariables> Variables;
};

} // namespace Lantern
