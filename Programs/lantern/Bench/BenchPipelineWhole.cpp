// RTPSOs from the plugin's compiler, without libraries.
#include "Bench/BenchPipelineWhole.h"

#include "LanternMeasure/Methods.h"
#include "LanternScene/Pipelines/RTPSOCompiler.h"

namespace Lantern
{

FRTStatus MakeWholeRTPSO(IRTDevice& Device, FShaderCompiler& Compiler, const FMaterialPrograms& Programs, const FRTPSODesc& Desc,
    FRTPSO& Out, double* OutDriverMs)
{
	FMethodScope Whole;
	Whole.Apply({{"r.RT.Pipeline.Libraries", "0", "bench"}});
	FConsoleVariables::Get().BeginFrame();
	FRTPSOCompiler Maker(Device, Compiler, Programs);
	const FRTStatus Status = Maker.Finish(Desc);
	Whole.Restore();
	FConsoleVariables::Get().BeginFrame();
	if (!Status) { return Status; }
	Out = *Maker.GetCurrent();
	if (Out.GetMissingCount() > 0) { return FRTStatus::Error(ERTResult::CompileFailed, "a hit program does not compile: see the log"); }
	// Without libraries the driver compiles in the link, and only there.
	if (OutDriverMs) { *OutDriverMs = Maker.GetStats().LastLinkMs; }
	return FRTStatus::Success();
}

} // namespace Lantern
