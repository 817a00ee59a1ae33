// Console variables: typed, named r.RT.<Pass>.<Knob>, defined beside the code that reads them.
//
//   static TRTConsoleVariable<int32_t> CVarShadowSamples("r.RT.Shadow.Samples", 1,
//       "Sun shadow rays per pixel.", {1, 64});
//   ... CVarShadowSamples.GetOnRenderThread()
//
// Values may be set from any thread. The value that the render thread reads changes only in FConsoleVariables::BeginFrame(), so
// that a change in the middle of a frame cannot break the frame.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace Lantern
{

/// Who set a value last. A lower setter never overrides a higher one (the order of UE, shortened).
enum class ERTSetBy : uint8_t
{
	Code,          ///< the default in the code
	Ini,           ///< DefaultLantern.ini and --config
	Scalability,   ///< Scalability.ini by --quality
	DeviceProfile, ///< DeviceProfiles.ini by device
	CommandLine,   ///< --set
	Console,       ///< the host at run time; always wins
};
const char* ToString(ERTSetBy By);

using FRTCVarValue = std::variant<bool, int32_t, float, std::string>;

/// Inclusive range. Values outside are clamped, with one warning. Ignored for bool and string.
struct FRTCVarRange
{
	double Min = -1e30, Max = 1e30;
};

/// The untyped part of a console variable. Has static storage; the constructor registers it.
class FRTConsoleVariable
{
public:
	FRTConsoleVariable(const char* Name, const FRTCVarValue& Default, const char* Help, FRTCVarRange Range);
	~FRTConsoleVariable();
	FRTConsoleVariable(const FRTConsoleVariable&) = delete;
	FRTConsoleVariable& operator=(const FRTConsoleVariable&) = delete;

	const std::string& GetName() const;
	const std::string& GetHelp() const;
	const FRTCVarValue& GetDefault() const;
	FRTCVarRange GetRange() const;
	ERTSetBy GetSetBy() const;
	FRTCVarValue GetValue() const; ///< the newest value; any thread
	/// BeginFrame calls Callback on its thread after the value changed.
	void SetCallback(std::function<void(const FRTConsoleVariable&)> Callback);

protected:
	friend class FConsoleVariables;
	struct FState;
	std::unique_ptr<FState> State;
};

template <class T> // bool, int32_t, float or std::string
class TRTConsoleVariable : public FRTConsoleVariable
{
public:
	TRTConsoleVariable(const char* Name, T Default, const char* Help, FRTCVarRange Range = {})
	    : FRTConsoleVariable(Name, FRTCVarValue(std::move(Default)), Help, Range)
	{}
	T Get() const { return std::get<T>(GetValue()); }
	/// Returns the value as of the last BeginFrame. Only on the thread that calls BeginFrame, and in tasks that it waits for.
	const T& GetOnRenderThread() const;
};

/// The registry of all console variables.
class FConsoleVariables
{
public:
	static FConsoleVariables& Get();

	/// Sets a variable by name or alias (case-insensitive, as in UE). Accepts 0/1/true/false for bool. Where is the place for
	/// the message ("--set", "Config/X.ini:12"). Returns a message if name, type or value is wrong; nothing changes then. The
	/// message names the nearest known name and is also logged as a warning. It is not an error if a higher ERTSetBy has set
	/// the variable; the value is then ignored.
	std::optional<std::string> Set(std::string_view Name, std::string_view Value, ERTSetBy By, std::string_view Where);
	const FRTConsoleVariable* Find(std::string_view NameOrAlias) const;
	std::vector<const FRTConsoleVariable*> GetAll() const; ///< sorted by name
	/// Makes Alias, an old or an engine's name, stand for Name. ConsoleVariableAliases.ini has one line for each. Factor: numbers that
	/// are set by the alias are multiplied by it, since an engine may count in other units. Finite and not 0.
	void AddAlias(std::string_view Alias, std::string_view Name, double Factor = 1.0);
	std::vector<std::pair<std::string, std::string>> GetAliases() const;

	/// Publishes values to the render thread and runs the callbacks of those that changed.
	void BeginFrame();
	uint64_t GetPublishCount() const; ///< calls of BeginFrame so far; any thread
	/// Returns whether some value was set that BeginFrame has not published. Any thread.
	bool HasUnpublished() const;
	/// Restores an earlier GetValue() and GetSetBy() of a variable, whoever set it since. Value must have the variable's type.
	void Restore(const FRTConsoleVariable& Variable, FRTCVarValue Value, ERTSetBy By);
	/// Resets all variables to their defaults and ERTSetBy::Code. For tests.
	void ResetAll();

	std::string ToMarkdown() const; ///< the text of Docs/ConsoleVariables.md
	std::string ToJson() const;
	static std::string ToString(const FRTCVarValue& Value);

private:
	FConsoleVariables();
	~FConsoleVariables();
	friend class FRTConsoleVariable;
	struct FImpl;
	std::unique_ptr<FImpl> Impl;
};

} // namespace Lantern
