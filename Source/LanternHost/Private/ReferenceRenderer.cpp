// Accumulates the reference path tracer over dispatches, with resume files.
#include "LanternHost/ReferenceRenderer.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternImage/AtomicFile.h"

namespace Lantern
{

namespace
{
using FClock = std::chrono::steady_clock;
double SecondsSince(FClock::time_point Start) { return std::chrono::duration<double>(FClock::now() - Start).count(); }

// Target time of a dispatch: short enough for a watchdog, long enough to hide the submission.
constexpr double TargetSeconds = 0.3;

struct FStateHeader
{
	char Magic[8] = {'L', 'N', 'T', 'R', 'E', 'F', '0', '1'};
	uint32_t Width = 0, Height = 0, Samples = 0, Bounces = 0, Seed = 0;
	uint32_t What = 0; // signal counted from the whole frame, and …Bit
	uint64_t Key = 0;
};

constexpr uint32_t PixelCentersBit = 1u << 16, RasterSurfacesBit = 1u << 17;

// FNV-1a. It identifies a set of settings and does not protect against intent.
uint64_t HashBytes(const void* Data, size_t Size, uint64_t Hash)
{
	for (size_t I = 0; I < Size; ++I) { Hash = (Hash ^ static_cast<const uint8_t*>(Data)[I]) * 1099511628211ull; }
	return Hash;
}

class FReferenceJob
{
public:
	FReferenceJob(FSampleEngine& InEngine, const FReferenceSettings& InSettings) : Engine(InEngine), Settings(InSettings) {}
	FRTStatus Run(FReferenceResult& Out);

private:
	FRTStatus CreateBuffers();
	FRTStatus LoadState(uint32_t& OutSamples);
	FRTStatus SaveState(uint32_t Samples);
	/// Runs a frame of the reference: calls Add with the context and what it works on.
	template <class FAdd>
	FRTStatus RunFrame(FAdd&& Add);
	FRTStatus Trace(uint32_t FirstSample, uint32_t SampleCount, uint32_t FirstRow, uint32_t RowCount);
	FRTStatus Grade();
	FRTStatus Copy(IRTBuffer& Dest, IRTBuffer& Source);
	FStateHeader MakeHeader(uint32_t Samples) const;
	void Adapt(double Seconds);

	FSampleEngine& Engine;
	const FReferenceSettings& Settings;
	TRTRef<IRTBuffer> Sum, Staging;
	uint32_t Rows = 16, Batch = 1;
	double DispatchSeconds = TargetSeconds; // of the last full-sized one
};

FRTStatus FReferenceJob::CreateBuffers()
{
	IRTDevice& Device = Engine.GetRenderer().GetDevice();
	const uint64_t Size = uint64_t(Settings.View.Width) * Settings.View.Height * sizeof(glm::vec4);
	const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::CopySource | ERTBufferUsage::CopyDest;
	if (FRTStatus S = Device.CreateBuffer({Size, Usage, ERTMemory::Device, "ReferenceSum"}, Sum.ReleaseAndGetAddress()); !S) { return S; }
	if (FRTStatus S = Device.CreateBuffer({Size, Usage, ERTMemory::Readback, "ReferenceStaging"}, Staging.ReleaseAndGetAddress()); !S)
	{
		return S;
	}
	std::memset(Staging->GetMapped(), 0, Size);
	return FRTStatus::Success();
}

FStateHeader FReferenceJob::MakeHeader(uint32_t Samples) const
{
	FStateHeader Header;
	Header.Width = Settings.View.Width;
	Header.Height = Settings.View.Height;
	Header.Samples = Samples;
	Header.Bounces = Settings.Bounces;
	Header.Seed = Settings.View.Seed;
	Header.What = static_cast<uint32_t>(Settings.Signal) | (Settings.bPixelCenters ? PixelCentersBit : 0u) |
	              (Settings.bRasterSurfaces ? RasterSurfacesBit : 0u);
	const FView& View = Settings.View;
	const double Camera[] = {View.Position.x, View.Position.y, View.Position.z, View.Forward.x, View.Forward.y, View.Forward.z, View.Up.x,
	    View.Up.y, View.Up.z, View.FovY, Settings.Time};
	Header.Key = HashBytes(Camera, sizeof(Camera), HashBytes(Settings.SceneKey.data(), Settings.SceneKey.size(), 14695981039346656037ull));
	return Header;
}

FRTStatus FReferenceJob::LoadState(uint32_t& OutSamples)
{
	OutSamples = 0;
	std::ifstream File(Settings.StateFile, std::ios::binary);
	if (!File) { return FRTStatus::Success(); } // nothing to resume
	FStateHeader Header;
	File.read(reinterpret_cast<char*>(&Header), sizeof(Header));
	const FStateHeader Wanted = MakeHeader(Header.Samples);
	if (!File || std::memcmp(&Header, &Wanted, sizeof(Header)) != 0)
	{
		return MakeFileError(ERTResult::InvalidArgument, Settings.StateFile,
		    "holds the state of another picture (scene, view, light or settings differ); remove it or leave --resume out");
	}
	const uint64_t Size = Staging->GetDesc().Size;
	File.read(static_cast<char*>(Staging->GetMapped()), static_cast<std::streamsize>(Size));
	if (!File) { return MakeFileError(ERTResult::IoError, Settings.StateFile, "is cut off"); }
	OutSamples = Header.Samples;
	return FRTStatus::Success();
}

FRTStatus FReferenceJob::SaveState(uint32_t Samples)
{
	if (FRTStatus S = Copy(*Staging, *Sum); !S) { return S; }
	if (Settings.StateFile.empty()) { return FRTStatus::Success(); }
	const FStateHeader Header = MakeHeader(Samples);
	return WriteFileAtomically(Settings.StateFile, [&](const std::string& Path) {
		std::ofstream File(Path, std::ios::binary);
		File.write(reinterpret_cast<const char*>(&Header), sizeof(Header));
		File.write(static_cast<const char*>(Staging->GetMapped()), static_cast<std::streamsize>(Staging->GetDesc().Size));
		File.close();
		return File ? FRTStatus::Success() : FRTStatus::Error(ERTResult::IoError, "cannot be written");
	});
}

FRTStatus FReferenceJob::Copy(IRTBuffer& Dest, IRTBuffer& Source)
{
	IRTDevice& Device = Engine.GetRenderer().GetDevice();
	TRTRef<IRTCommandList> List;
	if (FRTStatus S = Device.CreateCommandList("ReferenceCopy", List.ReleaseAndGetAddress()); !S) { return S; }
	if (FRTStatus S = List->Begin(); !S) { return S; }
	// Between copies the path tracer owns the sum, and the CPU owns the staging buffer.
	const auto Resting = [&](IRTBuffer& Buffer) { return &Buffer == Sum.Get() ? ERTAccess::StorageWrite : ERTAccess::HostRead; };
	const FRTBarrier Before[] = {
	    {&Source, nullptr, Resting(Source), ERTAccess::CopyRead}, {&Dest, nullptr, Resting(Dest), ERTAccess::CopyWrite}};
	const FRTBarrier After[] = {
	    {&Source, nullptr, ERTAccess::CopyRead, Resting(Source)}, {&Dest, nullptr, ERTAccess::CopyWrite, Resting(Dest)}};
	List->Barriers(Before, 2);
	List->CopyBuffer(&Dest, 0, &Source, 0, Dest.GetDesc().Size);
	List->Barriers(After, 2);
	if (FRTStatus S = List->End(); !S) { return S; }
	FRTFence Fence = 0;
	IRTCommandList* const Lists[] = {List.Get()};
	if (FRTStatus S = Device.Submit(Lists, 1, &Fence); !S) { return S; }
	return Device.WaitFor(Fence, 600'000'000'000ull);
}

template <class FAdd>
FRTStatus FReferenceJob::RunFrame(FAdd&& Add)
{
	FConsoleVariables::Get().BeginFrame();
	FRenderer& Renderer = Engine.GetRenderer();
	FFrameFeatures Features;
	Features.bReference = true;
	Features.ReferenceSignal = Settings.Signal;
	Features.bReferenceFromGBuffer = Settings.bRasterSurfaces;
	Features.Skinning = Engine.MoveTo(Settings.Time);
	if (FRTStatus S = Renderer.BeginFrame(Engine.GetScene().GetScene(), Settings.View, Features); !S) { return S; }
	FFrameContext& Context = Renderer.GetContext();
	FReferencePassInputs Inputs;
	Inputs.Sum = Context.Graph.ImportBuffer(Sum.Get(), ERTAccess::StorageWrite, ERTAccess::StorageWrite, "ReferenceSum");
	Inputs.Signal = Settings.Signal;
	if (Features.bReferenceFromGBuffer) { Inputs.GBuffer = Engine.AddGBuffer(Context); }
	Add(Context, Inputs);
	if (FRTStatus S = Renderer.EndFrame(nullptr); !S) { return S; }
	return Renderer.WaitForAll();
}

FRTStatus FReferenceJob::Trace(uint32_t FirstSample, uint32_t SampleCount, uint32_t FirstRow, uint32_t RowCount)
{
	return RunFrame([&](FFrameContext& Context, FReferencePassInputs& Inputs) {
		Inputs.FirstSample = FirstSample;
		Inputs.SampleCount = SampleCount;
		Inputs.MaxBounces = Settings.Bounces;
		Inputs.FirstRow = FirstRow;
		Inputs.RowCount = RowCount;
		Inputs.bPixelCenters = Settings.bPixelCenters;
		AddReferencePass(Context, Inputs);
	});
}

/// After the state is saved, whose sum more samples may join.
FRTStatus FReferenceJob::Grade()
{
	FConsoleVariables::Get().BeginFrame(); // of a state that was complete, no frame has been traced
	if (!Settings.bRasterSurfaces || !IsReferenceGraded(Engine.GetScene().GetScene().RefreshFacts(), Settings.Signal))
	{
		return FRTStatus::Success();
	}
	const FRTStatus Status =
	    RunFrame([](FFrameContext& Context, const FReferencePassInputs& Inputs) { AddReferenceGrade(Context, Inputs); });
	return Status ? Copy(*Staging, *Sum) : Status;
}

void FReferenceJob::Adapt(double Seconds)
{
	const double Factor = std::clamp(TargetSeconds / std::max(Seconds, 1e-4), 0.25, 4.0);
	const uint32_t Height = Settings.View.Height;
	const double Work = std::max(1.0, double(Rows) * Batch * Factor);
	Rows = static_cast<uint32_t>(std::clamp(Work, 1.0, double(Height)));
	Batch = Rows < Height ? 1u : static_cast<uint32_t>(std::clamp(Work / Height, 1.0, 256.0));
}

FRTStatus FReferenceJob::Run(FReferenceResult& Out)
{
	if (FRTStatus S = CreateBuffers(); !S) { return S; }
	uint32_t Done = 0;
	if (Settings.bResume && !Settings.StateFile.empty())
	{
		if (FRTStatus S = LoadState(Done); !S) { return S; }
	}
	Out.ResumedSamples = Done;
	if (FRTStatus S = Copy(*Sum, *Staging); !S) { return S; }
	const uint32_t Height = Settings.View.Height, First = Done;
	const auto Start = FClock::now();
	auto LastState = Start;
	Rows = std::min(Rows, Height);
	while (Done < Settings.Samples)
	{
		const uint32_t Samples = std::min(Batch, Settings.Samples - Done);
		for (uint32_t Row = 0; Row < Height;)
		{
			const uint32_t Count = std::min(Rows, Height - Row);
			const auto Before = FClock::now();
			if (FRTStatus S = Trace(Done, Samples, Row, Count); !S) { return S; }
			Row += Count;
			if (Count == Rows) { DispatchSeconds = SecondsSince(Before); } // a remainder says nothing
			if (Settings.Progress)
			{
				const double Fraction = Done - First + double(Samples) * Row / Height;
				Settings.Progress(First + Fraction, Settings.Samples,
				    SecondsSince(Start) / std::max(Fraction, 1e-6) * (Settings.Samples - First - Fraction));
			}
		}
		Done += Samples;
		Adapt(DispatchSeconds);
		if (!Settings.StateFile.empty() && SecondsSince(LastState) > Settings.StateSeconds)
		{
			if (FRTStatus S = SaveState(Done); !S) { return S; }
			LastState = FClock::now();
		}
	}
	if (FRTStatus S = SaveState(Done); !S) { return S; }
	if (FRTStatus S = Grade(); !S) { return S; }
	Out.Samples = Done;
	Out.Seconds = SecondsSince(Start);
	Out.Paths = uint64_t(Done - First) * Height * Settings.View.Width;
	const uint32_t Channels = GetSignalInfo(Settings.Signal).Channels;
	Out.Radiance = FImage(Settings.View.Width, Height, Channels);
	const auto* Sums = static_cast<const glm::vec4*>(Staging->GetMapped());
	for (size_t I = 0; I < Out.Radiance.GetPixelCount(); ++I)
	{
		for (uint32_t C = 0; C < Channels; ++C)
		{
			Out.Radiance.Pixels[Channels * I + C] = Sums[I][static_cast<int>(C)] / std::max(Sums[I].w, 1.0f);
		}
	}
	return FRTStatus::Success();
}
} // namespace

FRTStatus RenderReference(FSampleEngine& Engine, const FReferenceSettings& Settings, FReferenceResult& Out)
{
	return FReferenceJob(Engine, Settings).Run(Out);
}

} // namespace Lantern
