// The library of Boolean operations makes functions of text, as Emscripten's embind did by default. The policy of the page forbids
// it, so the two places in its script are replaced by closures that do the same.

const invokerOfText =
  "let[args,invokerFnBody]=createJsInvoker(argTypes,isClassMethodFunc,returns,isAsync);" +
  "args.push(invokerFnBody);var invokerFn=newFunc(Function,args)(...closureArgs);";

const invoker = `
var invokerFn=function(...given){
  if(given.length!==argCount-2)throwBindingError("function "+humanName+" called with "+given.length+" arguments, expected "+(argCount-2));
  const destructors=needsDestructorStack?[]:null;
  const first=isClassMethodFunc?1:2;
  const wired=[];
  if(isClassMethodFunc)wired.push(argTypes[1]["toWireType"](destructors,this));
  for(let i=2;i<argCount;++i)wired.push(argTypes[i]["toWireType"](destructors,given[i-2]));
  const rv=cppInvokerFunc(cppTargetFunc,...wired);
  if(needsDestructorStack)runDestructors(destructors);
  else for(let i=first;i<argCount;++i){
    const destroy=argTypes[i].destructorFunction;
    if(destroy!==null)destroy(wired[i-first]);
  }
  return returns?argTypes[0]["fromWireType"](rv):undefined;
};`;

const callerOfText = "var invokerFunction=newFunc(Function,params)(...args);";

const caller = `
var invokerFunction=function(obj,func,destructorsRef,at){
  const given=[];
  let place=at;
  for(let i=0;i<argCount;++i){
    given.push(types[i].readValueFromPointer(place));
    place+=types[i]["argPackAdvance"];
  }
  const rv=kind===1?Reflect.construct(func,given):func.call(kind===0?obj:given.shift(),...given);
  return retType.isVoid?undefined:emval_returnValue(retType,destructorsRef,rv);
};`;

/**
 * Returns the script without functions made of text. Throws if it is another version of the script.
 * @param {string} code
 * @returns {string}
 */
export function withoutTextFunctions(code) {
  const changed = code.replace(invokerOfText, () => invoker).replace(callerOfText, () => caller);
  if (/newFunc\(Function,/.test(changed) || changed === code)
    throw new Error("manifold-3d makes functions of text in other places than before: see site-embind.mjs");
  return changed;
}

export function embindWithoutText() {
  return {
    name: "tetrafront:embind-without-text",
    transform: (code, id) =>
      /\/manifold-3d\/manifold\.js$/.test(id) ? { code: withoutTextFunctions(code), map: null } : null,
  };
}
