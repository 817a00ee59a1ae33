// References of signals: traced by the reference path tracer, and cached on disk.
#include "LanternMeasure/SignalReference.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternCore/Text/Log.h"
#include "LanternHost/ReferenceRenderer.h"
#include "LanternHost/SceneHash.h"
#include "SignalReferenceFile.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;
using FClock = std::chrono::steady_clock;
double SecondsSince(FClock::time_point Start) { return std::chrono::duration<double>(FClock::now() - Start).count(); }

/// Counts what no shader's text says: whatever else changes what a reference of this description is.
constexpr uint32_t Generation = 2;

/// Away from the small seeds that frames use, whose noise must not be the reference's.
uint32_t MakeSeed(uint32_t Seed, uint32_t Half) { return 0x5245'4600u + 2 * Seed + Half; }

uint32_t GetHalfSamples(const FSignalReferenceDesc& Desc) { return std::max(1u, (Desc.Samples + 1) / 2); }

void AddVector(FContentHasher& Hash, const glm::dvec3& V) { Hash.AddBytes(&V, sizeof(V)); }

void AddLights(FContentHasher& Hash, const FRTScene& Scene)
{
	const FSunLight& Sun = Scene.GetSun();
	AddVector(Hash, Sun.Direction);
	AddVector(Hash, Sun.Color);
	Hash.Add(Sun.Irradiance);
	Hash.Add(Sun.AngularDiameter);
	AddVector(Hash, Scene.GetSky());
	Hash.Add(Scene.GetSkyProgram().has_value());
	if (Scene.GetSkyProgram())
	{
		const FSkyData Sky = Scene.MakeSkyData();
		Hash.AddBytes(&Sky, sizeof(Sky));
	}
	for (uint32_t Slot = 0; Slot < Scene.GetLights().GetSlotCount(); ++Slot)
	{
		FLightData Data = Scene.GetLights().GetTable()[Slot]; // which does not depend on the scene's origin
		Data.Number = 0;                                      // no picture shows it
		static_assert(sizeof(FLightData) == 60, "hashed as bytes: no padding");
		Hash.AddBytes(&Data, sizeof(Data));
	}
}

/// What may have been changed since the scene was loaded.
void AddMaterials(FContentHasher& Hash, const FRTScene& Scene, const FMaterialPrograms& Programs)
{
	Hash.Add(Scene.GetMaterials().Num());
	for (uint32_t Index = 0; Index < Scene.GetMaterials().Num(); ++Index)
	{
		FMaterialData Data = Scene.GetMaterials()[Index];
		// Which texture is the content's affair; where it lies in the heap changes from run to run.
		for (uint32_t& Texture : Data.Textures) { Texture = Texture == NO_TEXTURE ? 1u : 0u; }
		static_assert(sizeof(FMaterialData) == 352, "hashed as bytes: no padding");
		Hash.AddBytes(&Data, sizeof(Data));
		Hash.AddText(Programs.Get(Scene.GetMaterialProgram(Index)).Name);
	}
}

void AddToon(FContentHasher& Hash, const FToonStyle& Style)
{
	AddVector(Hash, Style.Center);
	AddVector(Hash, Style.Tint);
	for (const float Value : {Style.SphereWeight, Style.Bend, Style.MaxSaturation, Style.MaxValue}) { Hash.Add(Value); }
}

void AddObjects(FContentHasher& Hash, const FRTScene& Scene)
{
	for (uint32_t Slot = 0; Slot < Scene.GetObjectSlotCount(); ++Slot)
	{
		const FRTObjectInfo* const Object = Scene.FindObject(Slot);
		if (!Object) { continue; }
		Hash.Add(Slot);
		Hash.AddBytes(&Object->Transform, sizeof(Object->Transform));
		Hash.AddBytes(Object->Materials.data(), Object->Materials.size() * sizeof(uint32_t));
		Hash.Add(Object->Mask);
		Hash.AddText(Object->Geometry->GetInfo().Name);
		if (Object->Toon) { AddToon(Hash, *Object->Toon); }
	}
}

/// Console variables that reach the path tracer beside what its shaders' defines say.
void AddVariables(FContentHasher& Hash, ESignal Signal)
{
	std::vector<std::string> Names = {"r.RT.AlphaTest", "r.RT.Material.Override", "r.RT.Build.MemoryMB", "r.RT.Build.CoarserLevels",
	    "r.RT.Lights.Shadows.Point", "r.RT.Lights.Shadows.Spot", "r.RT.Lights.Shadows.Rect"};
	std::istringstream OfSignal(GetSignalInfo(Signal).ReferenceVariables);
	for (std::string Name; OfSignal >> Name;) { Names.push_back(Name); }
	for (const std::string& Name : Names)
	{
		const FRTConsoleVariable* const Variable = FConsoleVariables::Get().Find(Name);
		Hash.AddText(Variable ? FConsoleVariables::ToString(Variable->GetValue()) : std::string());
	}
}

void AddView(FContentHasher& Hash, const FView& View)
{
	AddVector(Hash, View.Position);
	AddVector(Hash, View.Forward);
	AddVector(Hash, View.Up);
	const FViewWindow Window = View.GetWindow();
	for (const double Edge : {Window.Left, Window.Right, Window.Bottom, Window.Top}) { Hash.Add(Edge); }
	Hash.Add(Window.bOrthographic);
	AddVector(Hash, glm::vec3(View.Jitter, 0.0f));
	AddVector(Hash, View.DepthError);
	Hash.Add(View.NormalError);
	Hash.Add(View.bDerivedNormals);
	Hash.Add(View.Near);
	Hash.Add(View.Width);
	Hash.Add(View.Height);
}

/// The scene is where the reference will have it.
FContentHash MakeKey(FSampleEngine& Engine, const FSignalReferenceDesc& Desc)
{
	FRTScene& Scene = Engine.GetScene().GetScene();
	FFrameFeatures Features;
	Features.bReference = true;
	Features.ReferenceSignal = Desc.Signal;
	Features.bReferenceFromGBuffer = Desc.bRasterSurfaces;
	FConsoleVariables::Get().BeginFrame();
	FContentHasher Hash;
	Hash.Add(Generation);
	const FContentHash& Content = Engine.GetScene().GetContentHash();
	Hash.Add(Content.Low);
	Hash.Add(Content.High);
	Hash.Add(Desc.Time);
	AddLights(Hash, Scene);
	AddMaterials(Hash, Scene, Engine.GetRenderer().GetPrograms());
	AddObjects(Hash, Scene);
	AddVariables(Hash, Desc.Signal);
	AddView(Hash, Desc.View);
	Hash.Add(Desc.Signal);
	Hash.Add(GetHalfSamples(Desc));
	Hash.Add(Desc.Bounces);
	Hash.Add(Desc.Seed);
	Hash.Add(Desc.bPixelCenters);
	Hash.Add(Desc.bRasterSurfaces);
	Hash.AddText(Desc.StateKey);
	Hash.AddText(Engine.GetRenderer().GetRayShaderKey(Scene, Features));
	if (Features.bReferenceFromGBuffer)
	{
		if (IsReferenceGraded(Scene.GetFacts(), Desc.Signal)) { Hash.Add(Desc.View.Exposure); }
		for (const FShaderSource& Source : ListReferenceComputeShaders(Scene.GetFacts(), Desc.Signal))
		{
			Hash.AddText(Engine.GetRenderer().GetCompiler().GetKey(Source));
		}
		FShaderCompiler& Compiler = Engine.GetRenderer().GetCompiler();
		Hash.AddText(Compiler.GetKey({"GBuffer/GBuffer.vert", ERTShaderStage::Vertex, {}, {}}));
		Hash.AddText(Compiler.GetKey({"GBuffer/GBuffer.frag", ERTShaderStage::Fragment, {}, {}}));
	}
	return Hash.Finish();
}

std::string MakePath(const FSignalReferenceDesc& Desc, const FContentHash& Key)
{
	const std::string Name = std::string(GetSignalInfo(Desc.Signal).Name) + "-" + Key.ToHex() + ".ref";
	return (fs::path(Desc.CacheFolder) / Name).string();
}

FRTStatus TraceHalf(FSampleEngine& Engine, const FSignalReferenceDesc& Desc, uint32_t Half, FClock::time_point Start, FImage& Out)
{
	FReferenceSettings Settings;
	Settings.View = Desc.View;
	Settings.View.Seed = MakeSeed(Desc.Seed, Half);
	Settings.View.FrameIndex = 0;
	Settings.View.bCut = true;
	Settings.Time = Desc.Time;
	Settings.Signal = Desc.Signal;
	Settings.bPixelCenters = Desc.bPixelCenters;
	Settings.bRasterSurfaces = Desc.bRasterSurfaces;
	Settings.Samples = GetHalfSamples(Desc);
	Settings.Bounces = Desc.Bounces;
	if (Desc.Progress)
	{
		Settings.Progress = [&](double Done, uint32_t Total, double) {
			const double Fraction = std::clamp(0.5 * (Half + Done / Total), 1e-6, 1.0);
			Desc.Progress(Fraction, SecondsSince(Start) * (1.0 - Fraction) / Fraction);
		};
	}
	FReferenceResult Result;
	if (FRTStatus S = RenderReference(Engine, Settings, Result); !S) { return S; }
	Out = std::move(Result.Radiance);
	return FRTStatus::Success();
}

FRTStatus Trace(FSampleEngine& Engine, const FSignalReferenceDesc& Desc, FSignalReference& Out)
{
	const FClock::time_point Start = FClock::now();
	if (FRTStatus S = TraceHalf(Engine, Desc, 0, Start, Out.A); !S) { return S; }
	if (FRTStatus S = TraceHalf(Engine, Desc, 1, Start, Out.B); !S) { return S; }
	Out.Seconds = SecondsSince(Start);
	return FRTStatus::Success();
}

void Store(const FSignalReferenceDesc& Desc, const FContentHash& Key, const FSignalReference& Reference)
{
	std::error_code Error;
	fs::create_directories(Desc.CacheFolder, Error);
	const FRTStatus Status = WriteReferenceFile(MakePath(Desc, Key), Key, Reference);
	if (!Status) { LogOnce(ERTLogLevel::Warning, std::string("references are not kept: ") + Status.Message); }
}
} // namespace

FRTStatus GetSignalReference(FSampleEngine& Engine, const FSignalReferenceDesc& Desc, FSignalReference& Out)
{
	Out = {};
	Engine.SeekTo(Desc.Time);
	const FContentHash Key = MakeKey(Engine, Desc);
	const bool bCache = !Desc.CacheFolder.empty();
	const FReferenceFileShape Shape{Desc.View.Width, Desc.View.Height, GetSignalInfo(Desc.Signal).Channels};
	Out.bFromCache = bCache && ReadReferenceFile(MakePath(Desc, Key), Key, Shape, Out);
	if (!Out.bFromCache)
	{
		if (FRTStatus S = Trace(Engine, Desc, Out); !S) { return S; }
		if (bCache) { Store(Desc, Key, Out); }
	}
	Out.Mean = Out.A;
	for (size_t I = 0; I < Out.Mean.Pixels.size(); ++I) { Out.Mean.Pixels[I] = 0.5f * (Out.A.Pixels[I] + Out.B.Pixels[I]); }
	return FRTStatus::Success();
}

std::string GetSignalReferenceFile(FSampleEngine& Engine, const FSignalReferenceDesc& Desc)
{
	Engine.SeekTo(Desc.Time);
	return MakePath(Desc, MakeKey(Engine, Desc));
}

} // namespace Lantern
