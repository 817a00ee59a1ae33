// A case of `lantern stability`: scene, motion and metric in one function, limits, and a planted fault.
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
	double Value = 0.0;          ///< NaN: could not be measured, which counts as failed
	std::optional<double> Limit; ///< absent: the value is only recorded
	bool bFloor = false;         ///< the limit is a minimum, not a maximum
	bool Holds() const { return !Limit || (bFloor ? Value >= *Limit : Value <= *Limit); }
};

struct FStabilityFault
{
	std::string Text; ///< what is broken, for the report
	/// Console variables set for the method's frames (not for references). Empty: the case itself breaks something if
	/// FStabilityStage::IsFaulty.
	std::vector<FMethodSetting> Settings;
};

struct FStabilityCase
{
	int Number;
	const char* Name;
	std::vector<ESignal> Signals; ///< signals that the case applies to
	/// Measures the case. Null: no method supports it yet.
	FRTStatus (*Measure)(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out) = nullptr;
	/// Makes the fault for a method. Null: the case itself breaks something, see FaultText.
	FStabilityFault (*MakeFault)(const FMethod& Method) = nullptr;
	const char* FaultText = "";
	/// The case tests the plugin, not a method, and runs once.
	bool bNoMethod = false;
};

std::span<const FStabilityCase> GetStabilityCases();

/// Returns those of the variables that exist, as settings.
std::vector<FMethodSetting> KnownSettings(std::initializer_list<std::pair<const char*, const char*>> Settings);

// The measurements. Each is described at its definition.
FRTStatus MeasureThinWall(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureTemple(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureHashOverflow(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureLightSwitch(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureTimeOfDay(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureFlicker(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureTinyEmitters(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureBoiling(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureDisocclusion(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureGhost(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureMirrorGhost(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureShadowLag(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureNotANumber(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureThinSpecular(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureLightGrid(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureFrameRate(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureFurnace(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureSeams(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureToonEdge(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureFarAway(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasurePlanes(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureMissingShaders(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureOddSizes(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureDoor(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureMirrorRoom(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureCarriedEmitter(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureCuts(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);
FRTStatus MeasureStreaming(FStabilityStage& Stage, std::vector<FStabilityFigure>& Out);

} // namespace Lantern
