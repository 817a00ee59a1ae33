// What a case of `lantern stability` is: scene, motion and metric in one function, its limits, and a planted fault.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "LanternMeasure/Methods.h"

namespace Lantern
{

class FStabilityStage;

/// One measured figure of a case; a case may have several.
struct FStabilityFigure
{
	std::string Part;            ///< "10 cm wall"
	double Value = 0.0;          ///< NaN: could not be measured, which does not hold
	std::optional<double> Limit; ///< absent: recorded only
	bool bFloor = false;         ///< the limit is the least, not the most
	bool Holds() const { return !Limit || (bFloor ? Value >= *Limit : Value <= *Limit); }
};

struct FStabilityFault
{
	std::string Text; ///< what is broken, for the report
	/// Console variables set for the method's frames (not for references). Empty: the case itself breaks something where
	/// FStabilityStage::IsFaulty.
	std::vector<FMethodSetting> Settings;
};

struct FStabilityCase
{
	int Number;
	const char* Name;
	std::vector<ESignal> Signals; ///< that it applies to
	/// Null: no method yet.
	FRTStatus (*Measure)(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out) = nullptr;
	/// By method; null: the case breaks something itself, see FaultText.
	FStabilityFault (*MakeFault)(const FMethod& Method) = nullptr;
	const char* FaultText = "";
	/// The case is about the plugin, not about a method: it runs once.
	bool bNoMethod = false;
};

std::span<const FStabilityCase> GetStabilityCases();

/// Those of the variables that there are, as settings.
std::vector<FMethodSetting> KnownSettings(std::initializer_list<std::pair<const char*, const char*>> Settings);

// The measurements; each is described where it is made.
FRTStatus MeasureThinWall(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureTimeOfDay(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureTinyEmitters(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureDisocclusion(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureGhost(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureShadowLag(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureNotANumber(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureFrameRate(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureFurnace(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureSeams(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureFarAway(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasurePlanes(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureMissingShaders(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureOddSizes(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);

} // namespace Lantern
